// Stage "tone": whole numbers to brightness in floating point, looked up and copied as bits.
// CPU twin: scarf_tone() in cpu_ref/stages/stages.h
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Numbers { int numbers[]; };
layout(std430, binding = 1) readonly buffer LevelsFloat { uint levels[]; };
layout(std430, binding = 2) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { TonePush pushed; };
TonePush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel < push.pixels) picture[pixel] = levels[clamp(numbers[pixel], 0, int(push.last_level))];
}
