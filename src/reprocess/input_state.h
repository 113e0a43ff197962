// What a record says of its input: the digest of its bytes, and by which the same input is known again.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "io/files/file_state.h"
#include "scarf/core/result.h"
#include "scarf/digest/digest.h"

namespace scarf::reprocess {

/// The files of a recording at one moment: itself, or all regular files below a folder but for those in
/// `out`, where the results go.
struct InputState {
  bool folder = false;
  std::map<std::string, FileState> files;  ///< by path in the folder; a file itself has the path ""
  int64_t noted_ns = 0;                    ///< the system's clock just before

  uint64_t bytes() const;
  /// The file's, if there is just one that is no pipe.
  std::optional<FileState> file() const;
};

/// Errors: io.
Result<InputState> input_state(const std::string& path, const std::string& out);

/// The bytes of a recording as a reader takes them.
struct BytesRead {
  Digest digest;
  uint64_t count = 0;

  void add(std::span<const uint8_t> bytes) {
    digest.add(bytes);
    count += bytes.size();
  }
};

struct InputIdentity {
  std::string sha256;
  uint64_t bytes = 0;
  /// Of one file whose later changes would show, see settled(); those of a folder are too many to be noted.
  std::optional<FileState> state;
};

/// Of a recording that was `before` before it was read. Its digest is that of the bytes `read`, if these are
/// all of a file or pipe; otherwise the files are read once more. Errors: io; bad_input, if they are no
/// longer what they were. Where only a time of last change is another one, the digest is made again to tell.
Result<InputIdentity> identify(const std::string& path, const std::string& out, const InputState& before,
                               BytesRead& read);

/// Whether the input is that of a record: by what was noted of it or, if that is another one, by its digest.
bool is_same_input(const std::string& path, const std::string& out, const InputState& now,
                   const InputIdentity& recorded);

}  // namespace scarf::reprocess
