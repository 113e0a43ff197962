// Stage "age" of time_window and sae: how long ago each pixel last fired, in steps of the brightness table.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer LastTime { int64_t last_time[]; };
layout(std430, binding = 1) writeonly buffer Ages { uint ages[]; };
layout(push_constant) uniform Push { SaeAgePush pushed; };
SaeAgePush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  int64_t last = last_time[pixel];
  if (push.planes == 2) last = max(last, last_time[push.pixels + pixel]);
  const int64_t now = packInt2x32(ivec2(push.now_low, push.now_high));
  // Pixels that never fired hold the smallest number, from which nothing is subtracted.
  uint age = push.last;
  if (last > now - int64_t(push.reach)) age = last >= now ? 0 : uint(now - last) / push.step;
  ages[pixel] = age;
}
