// What tells whether a file is still the one that it was, with the same content.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scarf {

/// A regular file at one moment, as the file system describes it. Two equal states are of the same content,
/// if the file was last changed a while before the first of them: see settled().
struct FileState {
  uint64_t device = 0;  ///< of the file system; not the same after every mount
  uint64_t inode = 0;
  uint64_t bytes = 0;
  int64_t modified_ns = 0;  ///< when the content was last written; programs can set it to anything
  int64_t changed_ns = 0;   ///< when the file, its times, links or rights were last changed; cannot be set

  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Of the file that the path leads to; nullopt if there is none, or it is not regular, as a pipe is not.
std::optional<FileState> file_state(const std::string& path);

/// What makes the content another one, in words such as "size 100 -> 120 bytes"; empty if nothing does. A
/// change of changed_ns alone does not tell: rights and links are changed without the content, and the
/// content with a time of modification that is set back.
std::string difference(const FileState& before, const std::optional<FileState>& after);

/// Whether a change after `now` (nanoseconds of the system's clock, when the state was taken) would show:
/// file systems count time in steps, of up to 2 s, within which two changes have the same time.
bool settled(const FileState& state, int64_t now);

/// Nanoseconds of the system's clock.
int64_t system_time_ns();

}  // namespace scarf
