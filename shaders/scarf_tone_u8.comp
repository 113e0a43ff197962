// SCARF, stage "tone": counts to 8-bit brightness, four pixels per word.
// CPU twin: scarf_tone() in cpu_ref/stages/stages.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Counts { ivec4 counts[]; };  // four pixels
layout(std430, binding = 1) readonly buffer LevelsU8 { uint levels[]; };
layout(std430, binding = 2) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { TonePush push; };

// The first levels travel as push constants: nearly all counts are small, and a lookup in memory is dear.
uint level(int count) {
  if (count >= kPushedLevels) return levels[count];
  const uint word = count < 4 ? push.levels_0_to_3 : push.levels_4_to_7;
  return word >> 8 * (count & 3) & 255;
}

void main() {
  const uint word = linear_index();
  if (4 * word >= push.pixels) return;
  // Behind the last pixel there are counts of no pixel, which may be anything.
  const ivec4 count = mix(ivec4(0), counts[word], lessThan(4 * word + uvec4(0, 1, 2, 3), uvec4(push.pixels)));
  picture[word] = level(count.x) | level(count.y) << 8 | level(count.z) << 16 | level(count.w) << 24;
}
