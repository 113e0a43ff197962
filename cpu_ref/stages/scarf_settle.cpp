// Twin of shaders/scarf_settle.comp.
#include "core/ring_head.h"
#include "cpu_ref/stages/stages.h"

namespace scarf::stages {

void scarf_settle(std::span<uint32_t> heads, std::span<uint64_t> laps, std::span<uint32_t> painted_heads) {
  for (size_t patch = 0; patch < heads.size(); ++patch) {
    laps[patch] += heads[patch] >> kHeadLapsShift;
    heads[patch] = head_slot(heads[patch]);
    painted_heads[patch] = layout::kNeverPainted;
  }
}

}  // namespace scarf::stages
