// Files that have to be regular ones: at a pipe, a socket or a device a program may wait for ever.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "scarf/core/result.h"

namespace scarf {

/// An open file, closed with its owner.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int get() const { return fd_; }
  /// Hands over the file, which is then the caller's to close.
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_ = -1;
};

/// Opens a regular file for reading, and never waits; a link is followed. Errors: io, saying why but not
/// which file, also for what is no regular file.
Result<FileDescriptor> open_regular(const std::string& path);

/// The same for libraries that open a file by its name. Errors: io.
Result<void> require_regular(const std::string& path);

/// The whole content of a regular file. Errors: io; bad_input for more than `limit` bytes.
Result<std::string> read_whole(const std::string& path, size_t limit);
Result<std::string> read_whole(const FileDescriptor& file, size_t limit);

}  // namespace scarf
