// Twin of shaders/scarf/scarf_paint.comp.
#include "cpu_ref/stages/scarf/stages.h"

namespace scarf::stages {

void scarf_paint(std::span<const uint8_t> positions, std::span<const uint32_t> heads,
                 std::span<uint32_t> painted_heads, std::span<uint8_t> picture,
                 const layout::PaintPush& push) {
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    if (heads[patch] == painted_heads[patch]) continue;
    painted_heads[patch] = heads[patch];
    const int32_t x_begin = push.cell_begin_x + static_cast<int32_t>(patch % push.grid_x * push.cell_x);
    const int32_t y_begin = push.cell_begin_y + static_cast<int32_t>(patch / push.grid_x * push.cell_y);
    uint32_t counts[layout::kNotShown + 1] = {};
    const uint32_t ring = push.groups * layout::kSlotsPerGroup;
    for (uint32_t s = 0; s < ring; ++s) counts[positions[size_t{patch} * ring + s]] += 1;
    for (uint32_t pixel = 0; pixel < push.cell_x * push.cell_y; ++pixel) {
      const int32_t x = x_begin + static_cast<int32_t>(pixel % push.cell_x);
      const int32_t y = y_begin + static_cast<int32_t>(pixel / push.cell_x);
      if (x < 0 || y < 0 || x >= static_cast<int32_t>(push.width) || y >= static_cast<int32_t>(push.height))
        continue;
      const uint32_t count = counts[pixel / push.cell_x * 4 * push.row_words + pixel % push.cell_x];
      const uint64_t levels = uint64_t{push.levels_4_to_7} << 32 | push.levels_0_to_3;
      const uint32_t shift = 8 * std::min(count, layout::kPushedLevels - 1);
      picture[size_t{push.width} * y + x] = static_cast<uint8_t>(levels >> shift);
    }
  }
}

}  // namespace scarf::stages
