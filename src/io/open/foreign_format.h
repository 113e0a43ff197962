// Files that are not read, known by their first bytes: so that the error can say what to do.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scarf {

struct ForeignFile {
  std::string_view what;  ///< what the file seems to be, and what to do with it; empty if unknown
  /// It stands in for a recording: an AEDAT file, a pointer of Git LFS, a page saved under a recording's
  /// name. What is passed over among the files of a data set must not be such a one.
  bool recording = false;
  bool stand_in = false;  ///< a pointer or a page: surely not the file itself, whatever format is named
};

/// `name`: the file's, whose extension tells what it should have been; of no use for pipes.
ForeignFile foreign_file(std::span<const uint8_t> bytes, const std::string& name);

/// Whether a file of this name that holds nothing is most likely a recording that was lost on its way: its
/// extension is that of recordings, or mostly of them.
bool is_lost_if_empty(const std::string& name);
/// Whether a file of this name is a broken recording if it is not recognised: nothing else has its extension.
bool is_recording_by_name(const std::string& name);

}  // namespace scarf
