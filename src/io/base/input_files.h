// The files that a recording is read from: whether they stay as they are meanwhile.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "io/base/byte_reader.h"
#include "io/files/file_state.h"
#include "scarf/core/result.h"

namespace scarf {

class BytesSeen;

/// A recording is of one moment. A file that grows, shrinks or is replaced while it is read is not, and what
/// was read of it is of no moment at all. So readers open their files here, and who hands out the recording
/// asks at its end (watched_source.h). Only regular files are watched: a pipe has no other content to compare
/// with. (A file that is to be followed while it grows would be one more that is opened without being added.)
class InputFiles {
 public:
  /// Opens a file for reading, and watches it from now on; "-" is standard input. Errors: io.
  Result<ByteReader> open(const std::string& path);
  /// The same for a file that belongs to a recording, and is no pipe or device. Errors: io.
  Result<ByteReader> open_regular(const std::string& path);
  /// Watches a file that a library is going to open by itself.
  void add(const std::string& path);

  /// Errors: bad_input, naming the first file that is not as it was. Where only the time of its last change
  /// is another one, the bytes that were read of it are read and compared again; of a file that a library
  /// reads these are none or its first.
  Result<void> unchanged() const;

 private:
  using Opening = Result<ByteReader> (*)(const std::string& path);
  Result<ByteReader> watch(const std::string& path, Opening opening);

  struct Watched {
    std::string path;
    FileState state;
    std::shared_ptr<const BytesSeen> seen;  // none: a library reads the file
  };

  mutable std::mutex mutex_;  // one thread may open the next file while another one asks
  std::vector<Watched> files_;
};

}  // namespace scarf
