// Twin of shaders/scarf/scarf_prune.comp.
#include <algorithm>

#include "cpu_ref/stages/scarf/stages.h"

namespace scarf::stages {

void scarf_prune(std::span<const uint32_t> table, std::span<uint32_t> alive, const layout::PrunePush& push) {
  const uint32_t grid_y = push.patches / push.grid_x;
  for (uint32_t c = 0; c < push.chunks; ++c) {
    for (uint32_t patch = 0; patch < push.patches; ++patch) {
      const uint32_t i = patch % push.grid_x;
      const uint32_t j = patch / push.grid_x;
      uint32_t& flag = alive[c * push.patches + patch];
      flag = 0;
      for (uint32_t b = j; b < std::min(j + push.most_rows, grid_y); ++b) {
        for (uint32_t a = i; a < std::min(i + push.most_columns, push.grid_x); ++a) {
          if (table[c * push.patches + b * push.grid_x + a] != layout::kCursorDead) flag = 1;
        }
      }
    }
  }
}

}  // namespace scarf::stages
