// AED-SAE, stage "list": the events in the list are counted, and their pixels marked. One invocation per run of events.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_state.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) readonly buffer StateBuffer { AedState state; };
layout(std430, binding = 3) buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer Counts { uint listed; };
layout(push_constant) uniform Push { AedImagePush pushed; };
AedImagePush push = pushed;

void main() {
  const uint begin = linear_index() * kAedRun;
  const uint end = min(begin + kAedRun, min(push.events, log_length));
  uint count = 0;
  // Trips: at most kAedRun.
  for (uint i = max(begin, state.start); i < end; ++i) {
    if (is_too_old(packInt2x32(ivec2(events[i].xy)), state.t_max, push.window)) continue;
    const uint xy = events[i].z;
    atomicOr(marks[(xy >> 16) * push.width + (xy & 0xFFFF)], 1);
    ++count;
  }
  if (count > 0) atomicAdd(listed, count);
}
