// AED-SAE, stage "u8": brightness in 8 bits. One invocation per four pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_value.glsl"
#include "common/invocation.glsl"

uint level(uint pixel) { return pixel < push.pixels ? uint(roundEven(255.0lf * value_of(pixel))) : 0; }

void main() {
  const uint word = linear_index();
  if (4 * word >= push.pixels) return;
  picture[word] = level(4 * word) | level(4 * word + 1) << 8 | level(4 * word + 2) << 16 | level(4 * word + 3) << 24;
}
