// How long the frames of a recording take by a replay.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scarf/device/replay.h"

namespace scarf::bench {

struct ReplayTime {
  double seconds = 0;  ///< from the first push until the last picture is in host memory
  uint64_t frames = 0;
  std::vector<StageTime> stages;  ///< device time; empty without timestamps
};

/// Replays the events with a u8 frame after each `events_per_frame` of them. Each frame is copied to host
/// memory of its own, as those of a stream are.
Result<ReplayTime> time_replay(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                               std::span<const Event> events, size_t events_per_frame);

}  // namespace scarf::bench
