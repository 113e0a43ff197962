// SCARF, stage "tone": counts to 8-bit brightness, four pixels per word.
// CPU twin: cpu_ref/stages/scarf_tone.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Counts { int counts[]; };
layout(std430, binding = 1) readonly buffer LevelsU8 { uint levels[]; };
layout(std430, binding = 2) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { TonePush push; };

uint level(uint pixel) { return pixel < push.pixels ? levels[counts[pixel]] : 0; }

void main() {
  const uint word = linear_index();
  const uint pixel = 4 * word;
  if (pixel >= push.pixels) return;
  picture[word] = level(pixel) | level(pixel + 1) << 8 | level(pixel + 2) << 16 | level(pixel + 3) << 24;
}
