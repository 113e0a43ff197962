// Event log, stage "write": the events of each run that are kept go to the places that the prefix sum gave.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "kernels/event_log_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "kernels/event_log.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) readonly buffer Places { uint places[]; };
layout(std430, binding = 4) writeonly buffer To { uvec4 to[]; };

void main() {
  const uint run = linear_index();
  const uint begin = run * kLogRun;
  const uint end = min(begin + kLogRun, events_in_buffer());
  if (begin >= end) return;
  uint place = places[run + 1];
  // Trips: at most kLogRun.
  for (uint i = begin; i < end; ++i) {
    const uvec4 event = from[push.first + i];
    if (!is_kept(push.first + i)) continue;
    to[place] = uvec4(event.xyz, event.w & 255);  // bytes 13 to 15 are padding
    ++place;
  }
}
