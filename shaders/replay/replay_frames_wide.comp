// Replay, stage "frames": as replay_frames_u8.comp, with 32 bits per pixel: the counts themselves, or brightness in
// floating point, looked up and copied as bits.
// CPU twin: replay_frames() in cpu_ref/stages/replay/replay.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
layout(constant_id = 1) const uint kLookUp = 1;  // 0: counts
#include "replay/replay_frames.glsl"

layout(std430, binding = 3) writeonly buffer Pictures { uvec4 pictures[]; };  // per frame

void main() {
  const uint index = linear_index();
  if (index >= push.invocations) return;
  uvec2 packed = read_counts(index);
  // Trips: push.frames, see make_replay_plan().
  for (uint frame = 0; frame < push.frames; ++frame) {
    packed += changes_in(frame, index);
    uvec4 n = unpack_counts(packed);
    if (kLookUp != 0) n = uvec4(level_of(n.x), level_of(n.y), level_of(n.z), level_of(n.w));
    pictures[frame * push.invocations + index] = n;
  }
  write_counts(index, packed + changes_in(push.frames, index));
}
