// Twin of shaders/scarf_count.comp.
#include "cpu_ref/stages/stages.h"
#include "cpu_ref/stages/walk.h"

namespace scarf::stages {

void scarf_count(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 const layout::BatchPush& push) {
  for_each_hit(events, ranges, push, [&](uint32_t chunk, const Event&, uint32_t i, uint32_t j) {
    table[chunk * push.patches + j * push.grid_x + i] += 1;
  });
}

}  // namespace scarf::stages
