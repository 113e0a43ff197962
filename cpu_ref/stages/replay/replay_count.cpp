// Twin of shaders/replay/replay_count.comp and running_sums.comp.
#include "cpu_ref/stages/replay/replay.h"
#include "cpu_ref/stages/replay/replay_walk.h"

namespace scarf::stages {

void replay_count(const ReplayEvents& group, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                  const layout::ReplayPush& push) {
  for_each_event(group, [&](uint32_t chunk, uint32_t e) {
    for_each_patch(group.events[e], ranges, push,
                   [&](uint32_t patch) { table[size_t{chunk} * push.stride + patch] += 1; });
  });
}

}  // namespace scarf::stages
