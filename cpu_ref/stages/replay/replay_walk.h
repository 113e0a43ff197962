// What the twins of the replay's stages share; shaders/replay/replay.glsl and replay_changes.glsl.
#pragma once

#include <cstdint>

#include "cpu_ref/stages/replay/replay.h"

namespace scarf::stages {

/// Calls visit(chunk, e) for each event of the group, in order.
template <class Visit>
void for_each_event(const ReplayEvents& group, Visit visit) {
  for (uint32_t chunk = 0; chunk + 1 < group.chunks.size(); ++chunk) {
    for (uint32_t e = group.chunks[chunk].begin; e < group.chunks[chunk + 1].begin; ++e) visit(chunk, e);
  }
}

/// Calls hit(patch) for each patch that holds an event.
template <class Hit>
void for_each_patch(uint32_t xy, std::span<const uint32_t> ranges, const layout::ReplayPush& push, Hit hit) {
  const uint32_t columns = ranges[xy & 0xFFFF];
  const uint32_t rows = ranges[push.width + 1 + (xy >> 16)];
  for (uint32_t j = rows & 0xFFFF; j <= rows >> 16; ++j) {
    for (uint32_t i = columns & 0xFFFF; i <= columns >> 16; ++i) hit(j * push.grid_x + i);
  }
}

/// The patch in whose cell an event is; kReplayNone if there is none.
inline uint32_t owner_of(uint32_t xy, const layout::ReplayPush& push) {
  const int32_t x = static_cast<int32_t>(xy & 0xFFFF) - push.origin_x;
  const int32_t y = static_cast<int32_t>(xy >> 16) - push.origin_y;
  if (x < 0 || y < 0) return layout::kReplayNone;
  const uint32_t i = static_cast<uint32_t>(x) / push.cell_x;
  const uint32_t j = static_cast<uint32_t>(y) / push.cell_y;
  return i < push.grid_x && j < push.grid_y ? j * push.grid_x + i : layout::kReplayNone;
}

/// The interval in which the patch has more than `hits` hits of the group for the first time; kReplayNone if
/// it never has.
inline uint32_t interval_beyond(const ReplayEvents& group, std::span<const uint32_t> table, uint32_t patch,
                                int64_t hits, const layout::ReplayPush& push) {
  for (uint32_t chunk = 0; chunk < push.chunks; ++chunk) {
    if (table[size_t{chunk} * push.stride + patch] > hits) return group.chunks[chunk].interval;
  }
  return layout::kReplayNone;
}

inline void change(std::span<uint32_t> changes, uint32_t interval, uint32_t pixel, int32_t one,
                   const layout::ReplayPush& push) {
  const uint64_t bit = uint64_t{pixel} * push.count_bits;
  changes[size_t{interval} * push.change_words + bit / 32] += static_cast<uint32_t>(one) << bit % 32;
}

}  // namespace scarf::stages
