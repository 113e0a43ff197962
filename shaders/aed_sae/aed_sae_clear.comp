// AED-SAE, stage "clear": no pixel has fired, if the submission has cleared the list; or at the start of a stream.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_state.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 0) buffer StateBuffer { AedState state; };
layout(std430, binding = 1) writeonly buffer LastTimes { int64_t last_times[]; };
layout(push_constant) uniform Push { AedPush pushed; };
AedPush push = pushed;

void main() {
  const uint index = linear_index();
  if (push.begin != 0 && index == 0) {
    state.start = 0;
    state.t_max = kNeverFired;
  }
  if (push.begin == 0 && state.cleared == 0) return;
  const uint end = min((index + 1) * kAedPixels, push.pixels);
  // Trips: kAedPixels.
  for (uint pixel = index * kAedPixels; pixel < end; ++pixel) last_times[pixel] = kNeverFired;
}
