// One pass of a discrete Fourier transform as in fourier.comp, for a small radix known to the compiler. One invocation per
// kRadix elements, each of which it loads and stores once.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
#include "kernels/fourier_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(constant_id = 0) const uint kRadix = 4;
layout(std430, binding = 0) readonly buffer From { dvec2 from[]; };
layout(std430, binding = 1) writeonly buffer To { dvec2 to[]; };
layout(std430, binding = 2) readonly buffer Roots { dvec2 roots[]; };  // exp(-2 pi i n / points), n = 0 .. points - 1
layout(push_constant) uniform Push { FourierPush pushed; };
FourierPush push = pushed;

dvec2 root_of(uint n) {
  const dvec2 w = roots[n];
  return push.inverse != 0 ? dvec2(w.x, -w.y) : w;
}

dvec2 product(dvec2 a, dvec2 b) { return dvec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

void main() {
  const uint index = linear_index();
  if (index >= push.elements / kRadix) return;
  const uint part = push.points / kRadix;
  const uint j = index / push.stride % part;
  const uint line = index / (push.stride * part) * (push.stride * push.points) + index % push.stride;
  const uint phase = j % push.done;
  const uint turn = part / push.done;
  dvec2 values[kRadix];
  // Trips: kRadix, at most 5.
  for (uint r = 0; r < kRadix; ++r) {
    values[r] = product(from[line + (j + r * part) * push.stride], root_of(r * phase * turn));
  }
  const uint first = (j - phase) * kRadix + phase;
  // Trips: kRadix * (kRadix + 1), at most 30.
  for (uint s = 0; s < kRadix; ++s) {
    dvec2 sum = values[0];
    for (uint r = 1; r < kRadix; ++r) sum += product(values[r], root_of(r * s % kRadix * part));
    to[line + (first + s * push.done) * push.stride] = sum;
  }
}
