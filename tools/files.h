// Output files that appear complete or not at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarf/result.h"

namespace scarf::tools {

/// A file that is written under a temporary name beside `path` and takes its place when it is complete.
/// A path that is there and is no regular file (a device, a pipe) is written directly.
class PendingFile {
 public:
  explicit PendingFile(const std::string& path);
  /// Removes the temporary file, unless put_in_place() was called.
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// The name to write to; it has the extension of the final name.
  const std::string& name() const { return name_; }
  /// Errors: io.
  Result<void> put_in_place();

 private:
  std::string path_;
  std::string name_;
};

/// Writes a whole file. Errors: io, also for a disk that is full.
Result<void> write_file(const std::string& path, std::span<const uint8_t> bytes);
Result<void> write_file(const std::string& path, const std::string& content);

}  // namespace scarf::tools
