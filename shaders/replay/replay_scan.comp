// Replay, stage "scan": hits per chunk become the number of hits before each chunk, one invocation per patch. The heads
// advance: where the ring would be written next before this group, and behind it.
// CPU twin: cpu_ref/stages/replay/replay_scan.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "replay/replay.glsl"
#include "common/views.glsl"

IMAGE_VIEW(2, TableView, table)  // per chunk and patch
layout(std430, binding = 3) buffer Heads { uvec2 heads[]; };

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  uint sum = 0;
  // Trips: push.chunks, see make_replay_plan().
  for (uint chunk = 0; chunk < push.chunks; ++chunk) {
    const int entry = int(chunk * push.stride + patch_id);
    const uint hits = IMAGE_WORD(table, entry);
    SET_IMAGE_WORD(table, entry, sum);
    sum += hits;
  }
  const uint head = heads[patch_id].y;
  heads[patch_id] = uvec2(head, (head + sum) % push.capacity);
}
