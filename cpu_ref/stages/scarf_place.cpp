// Twin of shaders/scarf_place.comp.
#include "core/packed_event.h"
#include "cpu_ref/stages/stages.h"
#include "cpu_ref/stages/walk.h"

namespace scarf::stages {

void scarf_place(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint64_t> slots, std::span<int32_t> counts, const layout::BatchPush& push) {
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
    const auto show = [&](const Event& e, int32_t change) {
      const int64_t x = int64_t{e.x} - field_x - push.margin_lo_x;
      const int64_t y = int64_t{e.y} - field_y - push.margin_lo_y;
      if (x >= 0 && x < push.cell_x && y >= 0 && y < push.cell_y)
        counts[size_t{e.y} * push.width + e.x] += change;
    };
    uint64_t& slot = slots[uint64_t{patch} * push.capacity + cursor];
    if (slot != kEmptySlot) show(unpack(slot, field_x, field_y, t_first), -1);
    slot = pack(event, field_x, field_y, t_first);
    show(event, 1);
    cursor = (cursor + 1) % push.capacity;
  });
}

}  // namespace scarf::stages
