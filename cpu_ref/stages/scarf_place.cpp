// Twin of shaders/scarf_place.comp.
#include "core/packed_event.h"
#include "cpu_ref/stages/stages.h"
#include "cpu_ref/stages/walk.h"

namespace scarf::stages {

void scarf_place(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint64_t> slots, std::span<uint8_t> positions, const layout::BatchPush& push) {
  const auto t_first = static_cast<int64_t>(uint64_t{push.t_first_high} << 32 | push.t_first_low);
  for_each_hit(events, ranges, push, [&](uint32_t chunk, const Event& event, uint32_t i, uint32_t j) {
    const uint32_t patch = j * push.grid_x + i;
    uint32_t& cursor = table[chunk * push.patches + patch];
    if (cursor == layout::kCursorDead) return;
    if (cursor >= layout::kCursorSkipOne) {
      cursor -= layout::kCursorSkipOne;
      return;
    }
    const int32_t field_x = push.field_x + static_cast<int32_t>(i * push.cell_x);
    const int32_t field_y = push.field_y + static_cast<int32_t>(j * push.cell_y);
    slots[uint64_t{patch} * push.capacity + cursor] = pack(event, field_x, field_y, t_first);
    if (!positions.empty()) {
      const int32_t x = event.x - field_x - static_cast<int32_t>(push.margin_lo_x);
      const int32_t y = event.y - field_y - static_cast<int32_t>(push.margin_lo_y);
      const bool active =
          x >= 0 && y >= 0 && x < static_cast<int32_t>(push.cell_x) && y < static_cast<int32_t>(push.cell_y);
      positions[uint64_t{patch} * push.ring_bytes + cursor] =
          static_cast<uint8_t>(active ? y * static_cast<int32_t>(push.row_bytes) + x : layout::kNotShown);
    }
    cursor = (cursor + 1) % push.capacity;
  });
}

}  // namespace scarf::stages
