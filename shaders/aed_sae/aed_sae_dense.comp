// AED-SAE, stage "dense": how many pixels are above the threshold.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Plane { dvec2 plane[]; };
layout(std430, binding = 1) buffer Counts { uint listed, dense; };
layout(push_constant) uniform Push { AedImagePush pushed; };
AedImagePush push = pushed;

void main() {
  const uint begin = linear_index() * kAedPixels;
  const uint end = min(begin + kAedPixels, push.pixels);
  uint count = 0;
  // Trips: at most kAedPixels.
  for (uint pixel = begin; pixel < end; ++pixel) count += plane[pixel].x > 0.001lf ? 1 : 0;
  if (count > 0) atomicAdd(dense, count);
}
