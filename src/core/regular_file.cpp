#include "core/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "core/text.h"

namespace scarf {
namespace {

Error system_error(std::string_view what) {
  return {ErrorCode::io, text(what, ": ", std::generic_category().message(errno))};
}

std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

Result<void> check_kind(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return {};
  return Error{ErrorCode::io, text("it is ", kind_of(status.st_mode), ", no regular file")};
}

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) close(fd_);
}

Result<FileDescriptor> open_regular(const std::string& path) {
  // Looked at first, because opening alone may do something to a device; and again, because it may be another
  // file by then.
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return system_error("cannot open");
  if (auto r = check_kind(status); !r) return r.error();
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) return system_error("cannot open");
  if (fstat(file.get(), &status) != 0) return system_error("cannot open");
  if (auto r = check_kind(status); !r) return r.error();
  return file;
}

Result<void> require_regular(const std::string& path) {
  const auto file = open_regular(path);
  return file ? Result<void>() : file.error();
}

Result<std::string> read_whole(const std::string& path, size_t limit) {
  const auto file = open_regular(path);
  return file ? read_whole(*file, limit) : file.error();
}

Result<std::string> read_whole(const FileDescriptor& file, size_t limit) {
  constexpr size_t kPiece = 64 * 1024;
  std::string content;
  for (;;) {
    const size_t size = content.size();
    // One byte more than the limit, to see that there is more.
    content.resize(size + std::min(kPiece, limit - size + 1));
    const ssize_t count = read(file.get(), content.data() + size, content.size() - size);
    content.resize(size + static_cast<size_t>(std::max<ssize_t>(count, 0)));
    if (count < 0 && errno != EINTR) return system_error("cannot read");
    if (count == 0) return content;
    if (content.size() > limit) {
      return Error{ErrorCode::bad_input, text("it has more than ", limit, " bytes")};
    }
  }
}

}  // namespace scarf
