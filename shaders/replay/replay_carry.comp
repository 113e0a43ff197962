// Replay, stage "carry": the events that earlier groups have left in the rings. Those that this group pushes out change
// the picture of an interval and are no longer kept. One invocation per patch and 32 slots.
// CPU twin: cpu_ref/stages/replay/replay_carry.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "replay/replay.glsl"
#include "replay/replay_changes.glsl"

void main() {
  const uint word = linear_index();
  if (word >= push.patches * push.kept_words) return;
  const uint patch_id = word / push.kept_words;
  const uint head = head_before(patch_id);
  uint left = kept[word];
  uint still = left;
  // Trips: at most 32, of at most 19 each for the search.
  for (; left != 0; left &= left - 1) {
    const uint slot = word % push.kept_words * 32 + findLSB(left);
    // The newest event is one slot before the head, the oldest in it. The hit of rank 0 is the first of this group, so
    // an event of age a has the rank -a, and is gone once there are more than capacity - a hits.
    const uint age = head > slot ? head - slot : head + push.capacity - slot;
    const uint gone = chunk_beyond(patch_id, 0, int(push.capacity - age));
    if (gone == push.chunks) continue;
    change(chunk_interval(gone), pixels[patch_id * push.capacity + slot], -1);
    still &= ~(left & -left);
  }
  kept[word] = still;
}
