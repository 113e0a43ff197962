// Replay, stage "frames": the sums of the changes are the counts of the pixels at each frame; 8-bit brightness of them,
// four pixels per word. One invocation per four pixels goes through all frames.
// CPU twin: replay_frames() in cpu_ref/stages/replay/replay.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "replay/replay_frames.glsl"

layout(std430, binding = 3) writeonly buffer Pictures { uint pictures[]; };  // per frame

// The first levels travel as push constants: most counts are small, and a lookup in memory is dear.
uint level(uint count) {
  if (count >= kPushedLevels) return level_of(count);
  const uint word = count < 4 ? push.levels_0_to_3 : push.levels_4_to_7;
  return word >> 8 * (count & 3) & 255;
}

void main() {
  const uint index = linear_index();
  if (index >= push.invocations) return;
  uvec2 packed = read_counts(index);
  // Trips: push.frames, see make_replay_plan().
  for (uint frame = 0; frame < push.frames; ++frame) {
    packed += changes_in(frame, index);
    const uvec4 n = unpack_counts(packed);
    pictures[frame * push.invocations + index] =
        level(n.x) | level(n.y) << 8 | level(n.z) << 16 | level(n.w) << 24;
  }
  write_counts(index, packed + changes_in(push.frames, index));
}
