// How long it takes to push events and to have images of them, for any implementation.
#pragma once

#include <cstdint>
#include <span>

#include "scarf/scarf.h"

namespace scarf::bench {

inline constexpr size_t kEventsPerImage = 100'000;

struct PushTime {
  double ns_per_event = 0;  ///< from the first push until the last image is in host memory, images included
  double query_us = 0;      ///< median time of one u8 image of a state whose pushes are done
};

/// Pushes the events in batches of kEventsPerImage, with one u8 image after each; `repeats` times on fresh
/// states, after one warm-up. Both figures are medians.
Result<PushTime> time_push(Scarf& scarf, std::span<const Event> events, int repeats);

}  // namespace scarf::bench
