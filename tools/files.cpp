#include "tools/files.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/text.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

bool written_directly(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

}  // namespace

PendingFile::PendingFile(const std::string& path) : path_(path), name_(path) {
  if (!written_directly(path)) {
    const fs::path file = path;
    name_ = (file.parent_path() / text(file.stem().string(), ".part", file.extension().string())).string();
  }
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (name_ != path_) fs::remove(name_, ignored);
}

Result<void> PendingFile::put_in_place() {
  if (name_ == path_) return {};
  std::error_code error;
  fs::rename(name_, path_, error);
  if (error) return Error{ErrorCode::io, text("cannot write ", path_, ": ", error.message())};
  name_ = path_;
  return {};
}

Result<void> write_file(const std::string& path, std::span<const uint8_t> bytes) {
  PendingFile pending(path);
  std::ofstream file(pending.name(), std::ios::binary);
  if (!file) {
    return Error{ErrorCode::io,
                 text("cannot create ", path, "; check that its folder exists and may be written")};
  }
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return Error{ErrorCode::io, text("cannot write ", path, "; check the space on its disk")};
  return pending.put_in_place();
}

Result<void> write_file(const std::string& path, const std::string& content) {
  return write_file(path, std::span(reinterpret_cast<const uint8_t*>(content.data()), content.size()));
}

}  // namespace scarf::tools
