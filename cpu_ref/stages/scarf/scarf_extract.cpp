// Twins of shaders/scarf/scarf_extract_count.comp, scarf_extract_scan.comp and scarf_extract_write.comp.
#include "cpu_ref/stages/scarf/patch.h"
#include "cpu_ref/stages/scarf/stages.h"
#include "layout/packed_event.h"

namespace scarf::stages {

void scarf_extract_count(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                         std::span<const uint64_t> laps, std::span<uint32_t> cursors,
                         const layout::PatchPush& push) {
  for (uint32_t index = 0; index < push.patches; ++index) {
    const uint32_t patch = push.first_patch + index;
    cursors[index] = 0;
    for (uint64_t s = 0; s < filled_slots(heads[patch], laps[patch], push); ++s) {
      if (push.mode == 0 || is_active(slots[uint64_t{patch} * push.capacity + s], push)) ++cursors[index];
    }
  }
}

uint32_t scarf_extract_scan(std::span<uint32_t> cursors) {
  uint32_t place = 0;
  for (uint32_t& cursor : cursors) {
    const uint32_t count = cursor;
    cursor = place;
    place += count;
  }
  return place;
}

void scarf_extract_write(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                         std::span<const uint64_t> laps, std::span<uint32_t> cursors, std::span<Event> out,
                         const layout::PatchPush& push) {
  const auto t_first = static_cast<int64_t>(uint64_t{push.t_first_high} << 32 | push.t_first_low);
  for (uint32_t index = 0; index < push.patches; ++index) {
    const uint32_t patch = push.first_patch + index;
    const uint64_t filled = filled_slots(heads[patch], laps[patch], push);
    const uint64_t oldest = filled < push.capacity ? 0 : head_slot(heads[patch]);
    for (uint64_t rank = 0; rank < filled; ++rank) {
      const uint64_t word = slots[uint64_t{patch} * push.capacity + (oldest + rank) % push.capacity];
      if (push.mode != 0 && !is_active(word, push)) continue;
      out[cursors[index]++] = unpack(word, patch_field_x(patch, push), patch_field_y(patch, push), t_first);
    }
  }
}

}  // namespace scarf::stages
