// Twin of shaders/replay/replay_rank.comp.
#include "cpu_ref/stages/replay/replay.h"
#include "cpu_ref/stages/replay/replay_walk.h"

namespace scarf::stages {

void replay_rank(const ReplayEvents& group, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint32_t> ranks, const layout::ReplayPush& push) {
  for_each_event(group, [&](uint32_t chunk, uint32_t e) {
    const uint32_t owner = owner_of(group.events[e], push);
    for_each_patch(group.events[e], ranges, push, [&](uint32_t patch) {
      const uint32_t hits = table[size_t{chunk} * push.stride + patch]++;
      if (patch == owner) ranks[e] = hits;
    });
  });
}

}  // namespace scarf::stages
