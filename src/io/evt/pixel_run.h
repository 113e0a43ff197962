// Events at the front of a stream that one mask of pixels can hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scarf/core/event.h"

namespace scarf {

/// Their number: of one time, row and polarity, from left to right, at pixels before `end`. At least 1.
inline size_t pixel_run(std::span<const Event> events, uint32_t end) {
  const Event& first = events.front();
  size_t run = 1;
  for (; run < events.size(); ++run) {
    const Event& e = events[run];
    if (e.t != first.t || e.y != first.y || e.p != first.p || e.x <= events[run - 1].x || e.x >= end) break;
  }
  return run;
}

/// Bit i: an event at pixel base + i.
inline uint32_t pixel_bits(std::span<const Event> run, uint32_t base) {
  uint32_t bits = 0;
  for (const Event& e : run) bits |= uint32_t{1} << (e.x - base);
  return bits;
}

}  // namespace scarf
