// Stage "tone": whole numbers to brightness in floating point, looked up and copied as bits.
// CPU twin: scarf_tone() in cpu_ref/stages/scarf/stages.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(0, NumbersView, numbers)
WORDS_VIEW(1, LevelsView, levels)
layout(std430, binding = 2) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { TonePush pushed; };
TonePush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  const int number = int(VIEW_WORD(numbers, pixel));
  picture[pixel] = VIEW_WORD(levels, clamp(number, 0, int(push.last_level)));
}
