// Twin of shaders/replay/replay_scan.comp.
#include "cpu_ref/stages/replay/replay.h"

namespace scarf::stages {

void replay_scan(std::span<uint32_t> table, std::span<uint32_t> heads, const layout::ReplayPush& push) {
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    uint32_t sum = 0;
    for (uint32_t chunk = 0; chunk < push.chunks; ++chunk) {
      uint32_t& entry = table[size_t{chunk} * push.stride + patch];
      const uint32_t hits = entry;
      entry = sum;
      sum += hits;
    }
    uint32_t* const head = &heads[2 * size_t{patch}];
    head[0] = head[1];
    head[1] = (head[0] + sum) % push.capacity;
  }
}

}  // namespace scarf::stages
