// Event log, stage "largest": the largest time of every kLargestTimes-th event; the host takes the largest of these.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "kernels/event_log_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) writeonly buffer Largest { int64_t largest[]; };
layout(push_constant) uniform Push { EventLogPush pushed; };
EventLogPush push = pushed;

const int64_t kSmallestTime = int64_t(0x8000000000000000ul);

void main() {
  const uint lane = linear_index();
  if (lane >= kLargestTimes) return;
  const uint end = min(push.events, log_length);
  int64_t t = kSmallestTime;
  // Trips: at most capacity / kLargestTimes, 2,048 for a log of 128 MiB.
  for (uint i = lane; i < end; i += kLargestTimes) t = max(t, packInt2x32(ivec2(events[i].xy)));
  largest[lane] = t;
}
