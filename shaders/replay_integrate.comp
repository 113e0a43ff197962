// Replay, stage "integrate": running sums along lines of the table, in place; first along all rows of patches, then
// along all columns. Turns the corners that replay_count.comp counted into hits.
// CPU twin: cpu_ref/stages/replay_count.cpp, which counts hits directly.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(binding = 0, r32ui) uniform uimageBuffer table;
layout(push_constant) uniform Push { ReplayIntegratePush pushed; };
ReplayIntegratePush push = pushed;

void main() {
  const uint line = linear_index();
  if (line >= push.chunks * push.lines) return;
  const uint begin = line / push.lines * push.stride + line % push.lines * push.line_stride;
  uint sum = 0;
  // Trips: patches of one axis, at most 49,152.
  for (uint i = 0; i < push.line_patches; ++i) {
    const int entry = int(begin + i * push.patch_stride);
    sum += imageLoad(table, entry).x;
    imageStore(table, entry, uvec4(sum));
  }
}
