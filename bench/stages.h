// Device time of each stage of SCARF beside the work that it has to do.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/stage_work.h"
#include "scarf/device/stream.h"

namespace scarf::bench {

struct StageFigure {
  std::string stage;
  uint64_t dispatches = 0;
  double ns_per_event = 0;
  std::optional<double> bytes_per_event;  ///< nullopt: no count for this stage
  double atomics_per_event = 0;
};

/// Pushes the events as time_push does, with an 8-bit image after each kEventsPerImage of them, and measures
/// these pushes only. `plan`: that of the stream. Empty where the device has no timestamps.
Result<std::vector<StageFigure>> measure_stages(GpuScarf& scarf, const Plan& plan,
                                                std::span<const Event> events);

}  // namespace scarf::bench
