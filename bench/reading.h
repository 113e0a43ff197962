// Times of readers, beside the plain reading of the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf::bench {

struct ReadTime {
  std::string format;
  uint64_t events = 0;
  uint64_t bytes = 0;                            ///< of the file
  double ns_per_event = 0;                       ///< processor time of all threads; median of the repeats
  double file_ns_per_event = 0;                  ///< of read() of the same file, likewise
  std::optional<double> unpacking_ns_per_event;  ///< of unpack_blocks, likewise; none: nothing to unpack
};

/// Reads the recording `repeats` times after one that warms the page cache, into a buffer that is used again.
/// Errors: those of open_events and read; bad_input for a recording without events.
Result<ReadTime> time_reading(const std::string& path, const ReadOptions& options, int repeats);

}  // namespace scarf::bench
