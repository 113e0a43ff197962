// Twin of shaders/scarf_place.comp.
#include "core/packed_event.h"
#include "cpu_ref/stages/stages.h"
#include "cpu_ref/stages/walk.h"

namespace scarf::stages {

void scarf_place(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint64_t> slots, const layout::BatchPush& push) {
  const auto t_first = static_cast<int64_t>(uint64_t{push.t_first_high} << 32 | push.t_first_low);
  for_each_hit(events, ranges, push, [&](uint32_t chunk, const Event& event, uint32_t i, uint32_t j) {
    const uint32_t patch = j * push.grid_x + i;
    uint32_t& cursor = table[chunk * push.patches + patch];
    if (cursor == layout::kCursorDead) return;
    if (cursor >= layout::kCursorSkipOne) {
      cursor -= layout::kCursorSkipOne;
      return;
    }
    slots[uint64_t{patch} * push.capacity + cursor] =
        pack(event, push.field_x + static_cast<int32_t>(i * push.cell_x),
             push.field_y + static_cast<int32_t>(j * push.cell_y), t_first);
    cursor = (cursor + 1) % push.capacity;
  });
}

}  // namespace scarf::stages
