// How many bytes events have on their way to a device, and what packing them costs.
#pragma once

#include <span>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf::bench {

struct WireCost {
  double bytes_per_event = 0;  ///< all words that are uploaded
  double pack_ns = 0;          ///< per event, of one core's time
  double copy_ns = 0;          ///< the same for a plain copy of the events
};

/// Packs the events in submissions of 2^20, `repeats` times; the fastest counts. At least one event.
WireCost time_wire(std::span<const Event> events, SensorSize sensor, int repeats);

}  // namespace scarf::bench
