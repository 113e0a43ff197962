// Twin of shaders/replay/replay_carry.comp.
#include "cpu_ref/stages/replay/replay.h"
#include "cpu_ref/stages/replay/replay_walk.h"

namespace scarf::stages {

void replay_carry(const ReplayEvents& group, const ReplayState& state, const layout::ReplayPush& push) {
  for (uint32_t patch = 0; patch < push.patches; ++patch) {
    const uint32_t head = state.heads[2 * size_t{patch}];
    // From the newest event, which is one slot before the head, to the oldest.
    for (uint32_t age = 1; age <= push.capacity; ++age) {
      const uint32_t slot = (head + push.capacity - age) % push.capacity;
      uint32_t& bits = state.kept[size_t{patch} * push.kept_words + slot / 32];
      const uint32_t bit = 1u << slot % 32;
      if ((bits & bit) == 0) continue;
      const uint32_t gone = interval_beyond(group, state.table, patch, int64_t{push.capacity} - age, push);
      if (gone == layout::kReplayNone) continue;
      change(state.changes, gone, state.pixels[size_t{patch} * push.capacity + slot], -1, push);
      bits &= ~bit;
    }
  }
}

}  // namespace scarf::stages
