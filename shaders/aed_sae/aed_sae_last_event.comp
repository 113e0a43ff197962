// AED-SAE, stage "last_event": the stamp of each pixel's last event since the last clear. Stamps number the events of the
// stream from 1 on. The largest is the same in whichever order atomics compare.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) buffer LastEvent { uint last_event[]; };

void main() {
  const uint index = linear_index();
  const uint i = old_length() + index;
  if (index >= push.events || i >= log_length || i < state.start) return;
  const uint xy = events[i].z;
  atomicMax(last_event[(xy >> 16) * push.width + (xy & 0xFFFF)], push.stamp + index);
}
