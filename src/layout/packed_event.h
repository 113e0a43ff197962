// The eight bytes that a ring-buffer slot holds on a device.
#pragma once

#include <cstdint>

#include "scarf/core/event.h"
#include "scarf/core/patch_grid.h"

namespace scarf {

// Bits 0..6 patch-local x, 7..13 patch-local y, 14 polarity, 15..63 signed microseconds since the stream's
// first event. The shaders pack and unpack the same way (shaders/common/packed_event.glsl).
inline constexpr int kPackedYShift = 7;
inline constexpr int kPackedPolarityShift = 14;
inline constexpr int kPackedTimeShift = 15;

// An empty slot: the time -2^48, which check_batch refuses.
inline constexpr uint64_t kEmptySlot = uint64_t{1} << 63;

inline uint64_t pack(const Event& e, int32_t field_x, int32_t field_y, int64_t t_first) {
  return static_cast<uint64_t>(e.x - field_x) | static_cast<uint64_t>(e.y - field_y) << kPackedYShift |
         static_cast<uint64_t>(e.p) << kPackedPolarityShift |
         (static_cast<uint64_t>(e.t) - static_cast<uint64_t>(t_first)) << kPackedTimeShift;
}

inline Event unpack(uint64_t word, int32_t field_x, int32_t field_y, int64_t t_first) {
  Event e;
  e.x = static_cast<uint16_t>(field_x + static_cast<int32_t>(word & 127));
  e.y = static_cast<uint16_t>(field_y + static_cast<int32_t>(word >> kPackedYShift & 127));
  e.p = static_cast<uint8_t>(word >> kPackedPolarityShift & 1);
  // The sum wraps only for times that check_batch refuses.
  e.t = static_cast<int64_t>(static_cast<uint64_t>(t_first) +
                             static_cast<uint64_t>(static_cast<int64_t>(word) >> kPackedTimeShift));
  return e;
}

}  // namespace scarf
