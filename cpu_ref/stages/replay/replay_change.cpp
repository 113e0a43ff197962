// Twin of shaders/replay/replay_change.comp.
#include "cpu_ref/stages/replay/replay.h"
#include "cpu_ref/stages/replay/replay_walk.h"

namespace scarf::stages {

void replay_change(const ReplayEvents& group, std::span<const uint32_t> ranks, const ReplayState& state,
                   const layout::ReplayPush& push) {
  for_each_event(group, [&](uint32_t chunk, uint32_t e) {
    const uint32_t xy = group.events[e];
    const uint32_t patch = owner_of(xy, push);
    if (patch == layout::kReplayNone) return;
    const uint32_t shown = group.chunks[chunk].interval;
    const uint32_t gone = interval_beyond(group, state.table, patch, int64_t{ranks[e]} + push.capacity, push);
    if (gone == shown) return;
    const uint32_t pixel = (xy >> 16) * push.width + (xy & 0xFFFF);
    change(state.changes, shown, pixel, 1, push);
    if (gone != layout::kReplayNone) {
      change(state.changes, gone, pixel, -1, push);
      return;
    }
    const uint32_t age = state.table[size_t{push.chunks - 1} * push.stride + patch] - ranks[e];
    const uint32_t slot = (state.heads[2 * size_t{patch} + 1] + push.capacity - age) % push.capacity;
    state.pixels[size_t{patch} * push.capacity + slot] = pixel;
    state.kept[size_t{patch} * push.kept_words + slot / 32] |= 1u << slot % 32;
  });
}

}  // namespace scarf::stages
