// What the twins of the render and extract stages share; shaders/scarf/scarf_patch.glsl.
#pragma once

#include <algorithm>
#include <cstdint>

#include "layout/ring_head.h"
#include "shaders/common/layout.h"

namespace scarf::stages {

inline uint64_t filled_slots(uint32_t head, uint64_t laps, const layout::PatchPush& push) {
  return std::min<uint64_t>(ring_total(head, laps, push.capacity), push.capacity);
}
inline int32_t patch_field_x(uint32_t patch, const layout::PatchPush& push) {
  return push.field_x + static_cast<int32_t>(patch % push.grid_x * push.cell_x);
}
inline int32_t patch_field_y(uint32_t patch, const layout::PatchPush& push) {
  return push.field_y + static_cast<int32_t>(patch / push.grid_x * push.cell_y);
}
inline bool is_active(uint64_t word, const layout::PatchPush& push) {
  const auto x = static_cast<uint32_t>(word & 127);
  const auto y = static_cast<uint32_t>(word >> 7 & 127);
  return x >= push.margin_lo_x && x < push.margin_lo_x + push.cell_x && y >= push.margin_lo_y &&
         y < push.margin_lo_y + push.cell_y;
}

}  // namespace scarf::stages
