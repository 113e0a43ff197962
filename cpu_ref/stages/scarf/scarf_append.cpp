// Twin of shaders/scarf/scarf_append.comp.
#include "cpu_ref/stages/scarf/stages.h"
#include "cpu_ref/stages/scarf/walk.h"
#include "layout/ring_head.h"

namespace scarf::stages {

void scarf_append(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> heads,
                  std::span<uint64_t> slots, std::span<uint8_t> positions, const layout::AppendPush& push) {
  for_each_hit(events, ranges, push, [&](uint32_t, const Event& event, uint32_t i, uint32_t j) {
    uint32_t& head = heads[j * push.grid_x + i];
    store_hit(event, i, j, head_slot(head), slots, positions, push);
    head += head_slot(head) + 1 < push.capacity ? 1 : layout::kHeadLap + 1 - push.capacity;
  });
}

}  // namespace scarf::stages
