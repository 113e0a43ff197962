// AED-SAE, stage "float": brightness in floating point.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_value.glsl"
#include "common/invocation.glsl"

void main() {
  const uint pixel = linear_index();
  if (pixel < push.pixels) picture[pixel] = floatBitsToUint(float(value_of(pixel)));
}
