// Many small streams on one device: submitted together, each by itself, and as one large stream.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bench/scenes.h"
#include "scarf/core/patch_grid.h"
#include "scarf/device/stream.h"

namespace scarf::bench {

inline constexpr size_t kStreamBatch = 10'000;  ///< events of one stream in one submission

/// Of a whole run: the time that passed, and the processor's time of the whole process, which other programs
/// do not disturb as much. A CPU device's work is in it.
struct StreamTime {
  double ns_per_event = 0;
  double cpu_ns_per_event = 0;
};

/// Medians.
struct StreamTimes {
  StreamTime one;       ///< one stream of `streams` times as large batches
  StreamTime together;  ///< all streams in one submission
  StreamTime alone;     ///< a submission per stream
  std::vector<StageTime> one_stages, together_stages;
  size_t events = 0;  ///< of one repeat, the same for all three
};

/// Pushes events of a scene in `rounds` rounds of a batch for each stream, flushed after each, `repeats`
/// times after a warm-up, and waits until the device is done; with `images` each round ends with a u8 image
/// of each stream in host memory, and with one of the large stream.
Result<StreamTimes> time_streams(std::shared_ptr<GpuContext> context, const Geometry& geometry, Scene scene,
                                 size_t streams, size_t rounds, int repeats, bool images);

}  // namespace scarf::bench
