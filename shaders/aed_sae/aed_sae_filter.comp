// AED-SAE, stage "filter": the spectrum times the largest weight minus a Gaussian whose quadrants are exchanged; an odd
// last row or column stays where it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) buffer Plane { dvec2 plane[]; };
layout(std430, binding = 1) readonly buffer Gaussians { double gaussians[]; };  // by column, then by row
layout(push_constant) uniform Push { AedImagePush pushed; };
AedImagePush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  uint x = pixel % push.width;
  uint y = pixel / push.width;
  const uint half_x = push.width / 2;
  const uint half_y = push.height / 2;
  if (x < 2 * half_x && y < 2 * half_y) {
    x = x < half_x ? x + half_x : x - half_x;
    y = y < half_y ? y + half_y : y - half_y;
  }
  precise double weight = gaussians[push.width + y] * gaussians[x];
  precise double filtered = packDouble2x32(uvec2(push.peak_low, push.peak_high)) - weight;
  plane[pixel] *= filtered;
}
