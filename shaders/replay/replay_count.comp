// Replay, stage "count": the corners of the rectangle of patches that hold an event, so that sums along rows and columns
// (running_sums.comp) give the hits of each chunk on each patch. A workgroup per chunk; a count does not depend on
// order, so atomics are exact.
// CPU twin: cpu_ref/stages/replay/replay_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "replay/replay.glsl"
#include "replay/replay_ranges.glsl"

layout(std430, binding = 2) buffer TableBuffer { uint table[]; };  // per chunk and patch

void count_corners(uint base, uvec2 first, uvec2 beyond) {
  const bool right = beyond.x < push.grid_x;
  const bool below = beyond.y < push.grid_y;
  atomicAdd(table[base + first.y * push.grid_x + first.x], 1);
  if (right) atomicAdd(table[base + first.y * push.grid_x + beyond.x], uint(-1));
  if (below) atomicAdd(table[base + beyond.y * push.grid_x + first.x], uint(-1));
  if (right && below) atomicAdd(table[base + beyond.y * push.grid_x + beyond.x], 1);
}

void main() {
  const uint chunk = linear_workgroup();
  if (chunk >= push.chunks) return;
  const uint end = chunk_begin(chunk + 1);
  // Trips: kMaxChunkEvents / kLinearGroup.
  for (uint e = chunk_begin(chunk) + gl_LocalInvocationID.x; e < end; e += kLinearGroup) {
    const uint xy = event_at(e);
    const uvec2 ranges_of_event = uvec2(columns_of(xy), rows_of(xy));
    const uvec2 first = ranges_of_event & 0xFFFF;
    const uvec2 beyond = (ranges_of_event >> 16) + 1;
    if (all(lessThan(first, beyond))) count_corners(chunk * push.stride, first, beyond);
  }
}
