// Events of one time, row and polarity that come as a mask of neighbouring pixels.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scarf/event.h"

namespace scarf {

struct PixelMask {
  uint32_t bits = 0;  ///< bit i: an event at pixel first.x + i, not yet written
  Event first;        ///< with the pixel of bit 0

  /// Writes events from left to right until `out` is full or no bit is left; returns their number.
  size_t write(std::span<Event> out) {
    size_t count = 0;
    while (bits != 0 && count < out.size()) {
      out[count] = first;
      out[count++].x = static_cast<uint16_t>(first.x + std::countr_zero(bits));
      bits &= bits - 1;
    }
    return count;
  }
};

}  // namespace scarf
