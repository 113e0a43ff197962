// How a stream on a device works: what its options choose never changes a result.
#pragma once

#include <cstdint>
#include <string>

namespace scarf {

struct GpuOptions {
  /// What push does when every staging slot is in flight: wait, or return ErrorCode::would_block.
  /// With would_block a large batch may be taken in part: PushReport::accepted tells how much.
  enum class WhenFull { wait, would_block } when_full = WhenFull::wait;
  /// Staging slots: batches that can be in flight at a time; 1 to 16.
  uint32_t staging_slots = 3;
  /// Events per submission; 0: chosen for the device. Larger batches are split, smaller ones are gathered
  /// until a query or flush() needs them. Never changes a result.
  uint32_t submission_events = 0;
  /// Events walked by one team of invocations; 0: chosen for the device. Never changes a result.
  uint32_t chunk_events = 0;
  /// How events of scarf get into the rings: as chunks side by side, or one after the other from the rings'
  /// heads on, for several parts of the patches side by side. automatic: as suits device and submission, but
  /// chunks if chunk_events is given. Never changes a result.
  enum class Placing { automatic, chunked, appended } placing = Placing::automatic;
  /// Bands of rows of patches that a core works on one after the other; 0: chosen for the device, at most 64.
  /// Never changes a result.
  uint32_t bands = 0;
};

/// Device time of one stage, summed over the submissions that were measured.
struct StageTime {
  std::string stage;  ///< "count", "scan", "place", "render", "tone", ...
  uint64_t dispatches = 0;
  uint64_t nanoseconds = 0;
};

}  // namespace scarf
