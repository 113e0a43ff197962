// How long it takes to push events and to have images of them, for any implementation.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "scarf/core/representation.h"

namespace scarf::bench {

inline constexpr size_t kEventsPerImage = 100'000;

struct PushTime {
  double ns_per_event = 0;  ///< from the first push until the last image is in host memory, images included
  double query_us = 0;      ///< median time of one u8 image of a state whose pushes are done
  uint64_t events = 0;      ///< of one repeat: fewer than were given where they would take long
};

/// Pushes the events in batches of kEventsPerImage, with one u8 image after each; `repeats` times on fresh
/// states, after one warm-up. Both figures are medians. Where one repeat would take more than 10 s, there are
/// fewer events in it, and at least two images.
Result<PushTime> time_push(Representation& representation, std::span<const Event> events, int repeats);

// What all measurements are made of.

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);
/// Of at least one value; of two, the greater.
double median(std::vector<double> values);

/// Pushes the events, with one u8 image after each `events_per_image` of them, and waits for everything. At
/// most `batch` events are pushed at a time. A few images are on their way while later events are pushed.
Result<void> push_and_render(Representation& representation, std::span<const Event> events,
                             size_t events_per_image, size_t batch);
/// Pushes the events, at most `batch` at a time, and waits until a device has done its work on them.
Result<void> push_and_finish(Representation& representation, std::span<const Event> events, size_t batch);
/// How long it takes, in seconds, to have one u8 image in host memory.
Result<double> time_query(Representation& representation);

}  // namespace scarf::bench
