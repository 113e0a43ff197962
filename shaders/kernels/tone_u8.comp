// Stage "tone": whole numbers to 8-bit brightness, four pixels per word.
// CPU twin: scarf_tone() in cpu_ref/stages/scarf/stages.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/views.glsl"

VECTORS_VIEW(0, NumbersView, numbers)  // four pixels
WORDS_VIEW(1, LevelsView, levels)
layout(std430, binding = 2) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { TonePush pushed; };
TonePush push = pushed;

// The first levels travel as push constants: most numbers are small, and a lookup in memory is dear.
uint level(int number) {
  const int n = clamp(number, 0, int(push.last_level));
  if (n >= kPushedLevels) return VIEW_WORD(levels, n);
  const uint word = n < 4 ? push.levels_0_to_3 : push.levels_4_to_7;
  return word >> 8 * (n & 3) & 255;
}

void main() {
  const uint word = linear_index();
  if (4 * word >= push.pixels) return;
  const ivec4 n = ivec4(VIEW_VECTOR(numbers, word));  // behind the last pixel there may be anything
  picture[word] = level(n.x) | level(n.y) << 8 | level(n.z) << 16 | level(n.w) << 24;
}
