// Twin of shaders/scarf_scan.comp.
#include <algorithm>

#include "cpu_ref/stages/stages.h"

namespace scarf::stages {

void scarf_scan(std::span<uint32_t> table, std::span<uint32_t> heads, std::span<uint64_t> totals,
                const layout::ScanPush& push) {
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    uint32_t hits = 0;
    for (uint32_t c = 0; c < push.chunks; ++c) hits += table[c * push.patches + patch];
    const int64_t overwritten = std::max<int64_t>(0, int64_t{hits} - push.capacity);
    int64_t rank = 0;
    for (uint32_t c = 0; c < push.chunks; ++c) {
      uint32_t& entry = table[c * push.patches + patch];
      const int64_t count = entry;
      const int64_t skip = std::clamp<int64_t>(overwritten - rank, 0, count);
      const int64_t slot = (heads[patch] + rank + skip) % push.capacity;
      entry = skip == count ? layout::kCursorDead : static_cast<uint32_t>(skip << 16 | slot);
      rank += count;
    }
    heads[patch] = (heads[patch] + hits) % push.capacity;
    totals[patch] += hits;
  }
}

}  // namespace scarf::stages
