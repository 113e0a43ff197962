// AED-SAE, stage "last_time": the last event of each pixel stores its time. A pixel's last event is one of them, so no two
// invocations write the same pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) readonly buffer LastEvent { uint last_event[]; };
layout(std430, binding = 5) writeonly buffer LastTimes { int64_t last_times[]; };

void main() {
  const uint index = linear_index();
  const uint i = old_length() + index;
  if (index >= push.events || i >= log_length || i < state.start) return;
  const uint xy = events[i].z;
  const uint pixel = (xy >> 16) * push.width + (xy & 0xFFFF);
  if (last_event[pixel] == push.stamp + index) last_times[pixel] = time_of(i);
}
