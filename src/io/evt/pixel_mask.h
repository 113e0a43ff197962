// Events of one time, row and polarity that come as a mask of neighbouring pixels.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/base/put_event.h"
#include "scarf/core/event.h"

namespace scarf {

struct PixelMask {
  uint32_t bits = 0;  ///< bit i: an event at pixel first.x + i, not yet written
  Event first;        ///< with the pixel of bit 0

  /// Writes events from left to right until `out` is full or no bit is left; returns their number.
  size_t write(std::span<Event> out) {
    constexpr size_t kAtOnce = 4;
    size_t count = 0;
    // Most masks have few bits, whose number no branch predictor learns: hence some at once, without a
    // branch. What is written for no bit is overwritten or not counted.
    while (bits != 0 && out.size() - count > kAtOnce) {
      for (size_t i = 0; i < kAtOnce; ++i) count += write_one(out[count]);
    }
    while (bits != 0 && count < out.size()) count += write_one(out[count]);
    return count;
  }

 private:
  size_t write_one(Event& out) {
    put_event(out, first.t, first.x + static_cast<uint32_t>(std::countr_zero(bits)), first.y, first.p);
    const size_t written = bits != 0 ? 1 : 0;
    bits &= bits - 1;
    return written;
  }
};

}  // namespace scarf
