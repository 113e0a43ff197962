// Twin of shaders/scarf/scarf_scan.comp.
#include <algorithm>

#include "cpu_ref/stages/scarf/stages.h"
#include "layout/ring_head.h"

namespace scarf::stages {

void scarf_scan(std::span<const uint32_t> sums, std::span<const uint32_t> patch_classes,
                std::span<uint32_t> table, std::span<uint32_t> heads, std::span<uint64_t> laps,
                std::span<uint32_t> painted_heads, const layout::ScanPush& push) {
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    const uint32_t columns = patch_classes[patch % push.grid_x];
    const uint32_t rows = patch_classes[push.grid_x + patch / push.grid_x];
    uint32_t hits = 0;
    for (uint32_t c = 0; c < push.chunks; ++c) {
      const auto sum = [&](uint32_t row, uint32_t column) {
        return sums[size_t{c} * push.class_words + row * push.class_columns + column];
      };
      uint32_t& count = table[c * push.patches + patch];
      count = sum(rows >> 16, columns >> 16) - sum(rows >> 16, columns & 0xFFFF) -
              sum(rows & 0xFFFF, columns >> 16) + sum(rows & 0xFFFF, columns & 0xFFFF);
      hits += count;
    }
    const int64_t overwritten = std::max<int64_t>(0, int64_t{hits} - push.capacity);
    int64_t rank = 0;
    for (uint32_t c = 0; c < push.chunks; ++c) {
      uint32_t& entry = table[c * push.patches + patch];
      const int64_t count = entry;
      const int64_t skip = std::clamp<int64_t>(overwritten - rank, 0, count);
      const int64_t slot = (head_slot(heads[patch]) + rank + skip) % push.capacity;
      entry = skip == count ? layout::kCursorDead : static_cast<uint32_t>(skip << 16 | slot);
      rank += count;
    }
    const uint64_t total = ring_total(heads[patch], laps[patch], push.capacity) + hits;
    if (hits != 0 || heads[patch] >> kHeadLapsShift != 0) painted_heads[patch] = layout::kNeverPainted;
    laps[patch] = total / push.capacity;
    heads[patch] = static_cast<uint32_t>(total % push.capacity);
  }
}

}  // namespace scarf::stages
