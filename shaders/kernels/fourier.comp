// One pass of a discrete Fourier transform along the lines of a plane, without a scale (Stockham's order: the result needs
// no permutation). One invocation per element of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "kernels/fourier_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer From { dvec2 from[]; };
layout(std430, binding = 1) writeonly buffer To { dvec2 to[]; };
layout(std430, binding = 2) readonly buffer Roots { dvec2 roots[]; };  // exp(-2 pi i n / points), n = 0 .. points - 1
layout(push_constant) uniform Push { FourierPush pushed; };
FourierPush push = pushed;

void main() {
  const uint element = linear_index();
  if (element >= push.elements) return;
  const uint place = element / push.stride % push.points;
  const uint line = element - place * push.stride;
  const uint span = push.done * push.radix;  // of the transforms that this pass completes
  const uint phase = place % span;
  const uint part = push.points / push.radix;
  const uint first = place / span * push.done + phase % push.done;
  const uint turn = push.points / span;
  uint root = 0;
  dvec2 sum = dvec2(0);
  // Trips: radix, at most 16,384.
  for (uint r = 0; r < push.radix; ++r) {
    const dvec2 value = from[line + (first + r * part) * push.stride];
    dvec2 w = roots[root * turn];
    if (push.inverse != 0) w.y = -w.y;
    sum += dvec2(value.x * w.x - value.y * w.y, value.x * w.y + value.y * w.x);
    root += phase;
    if (root >= span) root -= span;
  }
  to[element] = sum;
}
