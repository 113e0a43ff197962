// Twin of shaders/scarf/scarf_render.comp.
#include "cpu_ref/stages/scarf/patch.h"
#include "cpu_ref/stages/scarf/stages.h"

namespace scarf::stages {

void scarf_render(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                  std::span<const uint64_t> laps, std::span<int32_t> counts, const layout::PatchPush& push) {
  const size_t plane = size_t{push.width} * push.height;
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    const uint64_t end = std::min<uint64_t>(push.slot_end, filled_slots(heads[patch], laps[patch], push));
    for (uint64_t s = push.slot_begin; s < end; ++s) {
      const uint64_t word = slots[uint64_t{patch} * push.capacity + s];
      if (!is_active(word, push)) continue;
      const auto x = static_cast<size_t>(patch_field_x(patch, push) + static_cast<int32_t>(word & 127));
      const auto y = static_cast<size_t>(patch_field_y(patch, push) + static_cast<int32_t>(word >> 7 & 127));
      const bool on = (word >> 14 & 1) != 0;
      const size_t offset = push.mode == layout::kModeSeparate && on ? plane : 0;
      counts[offset + y * push.width + x] += push.mode == layout::kModeDifference && !on ? -1 : 1;
    }
  }
}

}  // namespace scarf::stages
