// Output files that appear complete or not at all.
#pragma once

#include <string>

#include "scarf/result.h"

namespace scarf {

/// A file that is written under a temporary name beside `path` and takes its place when it is complete.
/// A path that is there and is no regular file (a device, a pipe) is written directly; a link is followed.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  /// Removes the temporary file, unless put_in_place() was called.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The name to write to; it has the extension of the final name.
  const std::string& name() const { return name_; }
  /// Errors: io.
  Result<void> put_in_place();

 private:
  std::string path_;
  std::string name_;
  bool placed_ = false;
};

}  // namespace scarf
