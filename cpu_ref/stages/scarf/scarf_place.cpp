// Twin of shaders/scarf/scarf_place.comp.
#include "cpu_ref/stages/scarf/stages.h"
#include "cpu_ref/stages/scarf/walk.h"

namespace scarf::stages {

void scarf_place(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint64_t> slots, std::span<uint8_t> positions, const layout::BatchPush& push) {
  for_each_hit(events, ranges, push, [&](uint32_t number, const Event& event, uint32_t i, uint32_t j) {
    uint32_t& cursor = table[number / push.chunk_events * push.patches + j * push.grid_x + i];
    if (cursor == layout::kCursorDead) return;
    if (cursor >= layout::kCursorSkipOne) {
      cursor -= layout::kCursorSkipOne;
      return;
    }
    store_hit(event, i, j, cursor, slots, positions, push);
    cursor = (cursor + 1) % push.capacity;
  });
}

}  // namespace scarf::stages
