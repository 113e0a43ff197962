#include "reprocess/input_digest.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/byte_reader.h"
#include "scarf/digest/digest.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;

Result<void> add_file(Digest& digest, const fs::path& path) {
  auto file = ByteReader::open_regular(path.string());
  if (!file) return Error{file.error().code, text(path.string(), ": ", file.error().message)};
  for (;;) {
    if (const auto filled = file->fill(1); !filled) {
      return Error{filled.error().code, text(path.string(), ": ", filled.error().message)};
    }
    const auto bytes = file->available();
    if (bytes.empty()) return {};
    digest.add(bytes);
    file->skip(bytes.size());
  }
}

Result<void> add_folder(Digest& digest, const fs::path& folder, const std::string& out) {
  const auto names = files_below(folder.string(), out);
  if (!names) return names.error();
  for (const std::string& name : *names) {
    std::vector<uint8_t> head(name.begin(), name.end());
    head.push_back(0);
    std::error_code error;
    const uint64_t size = fs::file_size(folder / name, error);
    if (error)
      return Error{ErrorCode::io, text("cannot read ", (folder / name).string(), ": ", error.message())};
    append_little_endian(head, size);
    digest.add(head);
    if (auto r = add_file(digest, folder / name); !r) return r;
  }
  return {};
}

}  // namespace

Result<std::vector<std::string>> files_below(const std::string& folder, const std::string& out) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_directory(ignored) && fs::equivalent(entry->path(), out, ignored)) {
      entry.disable_recursion_pending();
    }
    if (entry->is_regular_file(ignored))
      names.push_back(entry->path().lexically_relative(folder).generic_string());
  }
  if (error) return Error{ErrorCode::io, text("cannot list ", folder, ": ", error.message())};
  std::sort(names.begin(), names.end());
  return names;
}

Result<std::string> input_digest(const std::string& path, const std::string& out) {
  Digest digest;
  std::error_code ignored;
  const auto added = fs::is_directory(path, ignored) ? add_folder(digest, path, out) : add_file(digest, path);
  if (!added) return added.error();
  return digest.hex();
}

}  // namespace scarf::reprocess
