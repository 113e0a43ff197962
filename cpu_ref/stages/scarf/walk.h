// The walk over the hits of a batch, and what a patch keeps of one: shaders/scarf/scarf_hit.glsl.
#pragma once

#include <algorithm>
#include <span>

#include "layout/packed_event.h"
#include "scarf/core/event.h"
#include "shaders/common/layout.h"

namespace scarf::stages {

/// Calls hit(number, event, i, j) for each patch (i, j) of each event, in order. Push: BatchPush or
/// AppendPush.
template <class Push, class Hit>
void for_each_hit(std::span<const Event> events, std::span<const uint32_t> ranges, const Push& push,
                  Hit hit) {
  for (uint32_t e = 0; e < push.events; ++e) {
    const Event& event = events[push.first_event + e];
    const uint32_t columns = ranges[std::min<uint32_t>(event.x, push.width)];
    const uint32_t rows = ranges[push.width + 1 + std::min<uint32_t>(event.y, push.height)];
    for (uint32_t j = rows & 0xFFFF; j <= rows >> 16; ++j) {
      for (uint32_t i = columns & 0xFFFF; i <= columns >> 16; ++i) hit(e, event, i, j);
    }
  }
}

/// Stores the hit of an event on patch (i, j) in a slot of its ring, and its position if there are any.
template <class Push>
void store_hit(const Event& event, uint32_t i, uint32_t j, uint32_t slot, std::span<uint64_t> slots,
               std::span<uint8_t> positions, const Push& push) {
  const auto t_first = static_cast<int64_t>(uint64_t{push.t_first_high} << 32 | push.t_first_low);
  const uint64_t patch = j * push.grid_x + i;
  const int32_t field_x = push.field_x + static_cast<int32_t>(i * push.cell_x);
  const int32_t field_y = push.field_y + static_cast<int32_t>(j * push.cell_y);
  slots[patch * push.capacity + slot] = pack(event, field_x, field_y, t_first);
  if (positions.empty()) return;
  const int32_t x = event.x - field_x - static_cast<int32_t>(push.margin_lo_x);
  const int32_t y = event.y - field_y - static_cast<int32_t>(push.margin_lo_y);
  const bool active =
      x >= 0 && y >= 0 && x < static_cast<int32_t>(push.cell_x) && y < static_cast<int32_t>(push.cell_y);
  positions[patch * push.ring_bytes + slot] =
      static_cast<uint8_t>(active ? y * static_cast<int32_t>(push.row_bytes) + x : layout::kNotShown);
}

}  // namespace scarf::stages
