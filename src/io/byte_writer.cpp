#include "io/byte_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

Error system_error(const std::string& path, const char* what) {
  return {ErrorCode::io, text(path, ": ", what, ": ", std::generic_category().message(errno))};
}

}  // namespace

ByteWriter::ByteWriter(int fd, std::string path, std::unique_ptr<AtomicFile> file)
    : fd_(fd), path_(std::move(path)), file_(std::move(file)) {}

ByteWriter::ByteWriter(ByteWriter&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      buffer_(std::move(other.buffer_)) {}

ByteWriter::~ByteWriter() {
  if (fd_ >= 0) close(fd_);
}

Result<ByteWriter> ByteWriter::create(const std::string& path) {
  if (path == "-") return standard_output();
  auto file = std::make_unique<AtomicFile>(path);
  ByteWriter writer(-1, path, std::move(file));  // owns the descriptor from its first moment on
  writer.fd_ = open(writer.file_->name().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (writer.fd_ < 0) return system_error(path, "cannot create");
  return writer;
}

Result<ByteWriter> ByteWriter::standard_output() {
  ByteWriter writer(-1, "standard output", nullptr);
  writer.fd_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  if (writer.fd_ < 0) return system_error(writer.path_, "cannot write");
  return writer;
}

Result<void> ByteWriter::flush() {
  if (fd_ < 0)
    return Error{ErrorCode::io, text(path_, ": is finished already; create it anew to write more")};
  for (size_t at = 0; at < buffer_.size();) {
    const ssize_t count = write(fd_, buffer_.data() + at, buffer_.size() - at);
    if (count >= 0)
      at += static_cast<size_t>(count);
    else if (errno != EINTR)
      return system_error(path_, "cannot write");
  }
  buffer_.clear();
  return {};
}

Result<void> ByteWriter::overwrite(uint64_t offset, std::string_view bytes) {
  if (const auto flushed = flush(); !flushed) return flushed;
  while (!bytes.empty()) {
    const ssize_t count = pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno != EINTR) return system_error(path_, "cannot complete");
    if (count <= 0) continue;
    bytes.remove_prefix(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
  return {};
}

Result<void> ByteWriter::finish() {
  if (const auto flushed = flush(); !flushed) return flushed;
  if (close(std::exchange(fd_, -1)) != 0) return system_error(path_, "cannot close");
  return file_ ? file_->put_in_place() : Result<void>();
}

}  // namespace scarf
