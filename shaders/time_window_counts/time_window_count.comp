// time_window with counts, stage "count": how many events of the window each pixel has. One invocation per event of the
// log: a count does not depend on order, so atomics are exact.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "time_window_counts/time_window_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { TimeWindowPush pushed; };
TimeWindowPush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= min(push.events, log_length)) return;
  const int64_t t = packInt2x32(ivec2(events[e].xy));
  if (t < packInt2x32(ivec2(push.since_low, push.since_high))) return;
  const uint xy = events[e].z;
  atomicAdd(counts[(xy >> 16) * push.width + (xy & 0xFFFF)], 1);
}
