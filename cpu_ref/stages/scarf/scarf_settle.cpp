// Twin of shaders/scarf/scarf_settle.comp.
#include "cpu_ref/stages/scarf/stages.h"
#include "layout/ring_head.h"

namespace scarf::stages {

void scarf_settle(std::span<uint32_t> heads, std::span<uint64_t> laps, std::span<uint32_t> painted_heads) {
  for (size_t patch = 0; patch < heads.size(); ++patch) {
    laps[patch] += heads[patch] >> kHeadLapsShift;
    heads[patch] = head_slot(heads[patch]);
    painted_heads[patch] = layout::kNeverPainted;
  }
}

}  // namespace scarf::stages
