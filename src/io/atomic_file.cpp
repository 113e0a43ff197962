#include "io/atomic_file.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "core/text.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;

bool written_directly(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

// Where a link leads to; any other path as it is.
std::string link_followed(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target.string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(link_followed(path)), name_(path_) {
  if (!written_directly(path_)) {
    const fs::path file = path_;
    name_ = (file.parent_path() / text(file.stem().string(), ".part", file.extension().string())).string();
  }
}

AtomicFile::~AtomicFile() {
  if (name_ != path_ && !placed_) unlink(name_.c_str());  // allocates nothing
}

Result<void> AtomicFile::put_in_place() {
  if (name_ == path_ || placed_) return {};
  std::error_code error;
  fs::rename(name_, path_, error);
  if (error) return Error{ErrorCode::io, text("cannot write ", path_, ": ", error.message())};
  placed_ = true;
  return {};
}

}  // namespace scarf
