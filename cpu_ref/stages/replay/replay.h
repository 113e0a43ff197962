// CPU twins of the stages of a replay: the same buffers in, the same buffers out. Plain loops.
#pragma once

#include <cstdint>
#include <span>

#include "shaders/replay/replay_layout.h"

namespace scarf::stages {

/// The events of a group, x | y << 16 each, and its chunks, with the last entry that begins where they end.
struct ReplayEvents {
  std::span<const uint32_t> events;
  std::span<const layout::ReplayChunk> chunks;
};

/// shaders/replay/replay_count.comp and running_sums.comp: adds the hits of each chunk on each patch to
/// `table` (chunk-major, push.stride).
void replay_count(const ReplayEvents& group, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                  const layout::ReplayPush& push);

/// shaders/replay/replay_scan.comp: hits become hits before; heads (before and behind the group) advance.
void replay_scan(std::span<uint32_t> table, std::span<uint32_t> heads, const layout::ReplayPush& push);

/// shaders/replay/replay_rank.comp: the rank of each event among the hits of the patch in whose cell it is;
/// events in no cell are left out. Hits before each chunk become hits by its end.
void replay_rank(const ReplayEvents& group, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint32_t> ranks, const layout::ReplayPush& push);

/// What the carry and change stages read and write.
struct ReplayState {
  std::span<const uint32_t> table;
  std::span<const uint32_t> heads;
  std::span<uint32_t> changes;
  std::span<uint32_t> kept;
  std::span<uint32_t> pixels;
};

/// shaders/replay/replay_carry.comp: the kept events that the group pushes out.
void replay_carry(const ReplayEvents& group, const ReplayState& state, const layout::ReplayPush& push);

/// shaders/replay/replay_change.comp: the events of the group.
void replay_change(const ReplayEvents& group, std::span<const uint32_t> ranks, const ReplayState& state,
                   const layout::ReplayPush& push);

/// shaders/replay/replay_frames_u8.comp and replay_frames_wide.comp: `levels` of the sums of `changes`, for
/// pictures of 4 * push.invocations pixels; `counts` (packed as the changes are, count_bits each) advances.
template <class Level>
void replay_frames(std::span<const uint32_t> changes, std::span<uint32_t> counts,
                   std::span<const Level> levels, std::span<Level> pictures, uint32_t count_bits,
                   const layout::ReplayFramesPush& push) {
  const uint32_t mask = (1u << count_bits) - 1;
  const uint32_t pixels = layout::kReplayPixels * push.invocations;
  for (uint32_t interval = 0; interval <= push.frames; ++interval) {
    for (size_t word = 0; word < counts.size(); ++word)
      counts[word] += changes[interval * counts.size() + word];
    if (interval == push.frames) break;
    for (uint32_t pixel = 0; pixel < pixels; ++pixel) {
      const uint64_t bit = uint64_t{pixel} * count_bits;
      pictures[size_t{interval} * pixels + pixel] = levels[counts[bit / 32] >> bit % 32 & mask];
    }
  }
}

}  // namespace scarf::stages
