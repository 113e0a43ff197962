// What a device does for a host that hands it a stream: throughput with frames back, kernel time, latency.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/ceilings.h"
#include "scarf/device/stream.h"

namespace scarf::bench {

struct Offload {
  uint64_t events = 0;
  double kernel_ns_per_event = 0;  ///< device time of the stages of pushes; 0: no timestamps
  double stream_events_per_s = 0;  ///< from host memory, with a u8 image at each frame in host memory
  double frames_per_s = 0;         ///< of those
  double copy_fraction = 0;        ///< bytes that crossed per second, of what the device copies at most
  double latency_median_us = 0;  ///< from "a small batch is handed over" until its u8 image is in host memory
  double latency_p99_us = 0;
  std::vector<StageTime> stages;
};

inline constexpr size_t kOffloadBatch = 1'000'000;
inline constexpr size_t kLatencyBatch = 10'000;

/// SCARF `paper` on a uniform scene; `events` of them, in batches of kOffloadBatch with an image after each:
/// 100 Hz at 100 million events per second. `latencies`: how many small batches are timed.
Result<Offload> measure_offload(std::shared_ptr<GpuContext> context, const Ceilings& ceilings,
                                SensorSize sensor, size_t events, size_t latencies);

}  // namespace scarf::bench
