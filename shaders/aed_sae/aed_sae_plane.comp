// AED-SAE, stage "plane": the marked pixels as a plane of complex numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 1) writeonly buffer Plane { dvec2 plane[]; };
layout(push_constant) uniform Push { AedImagePush pushed; };
AedImagePush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel < push.pixels) plane[pixel] = dvec2(marks[pixel], 0);
}
