// Encoding time surface, stage "newest": the smallest age of each pixel and polarity; first the high words, then, among
// the events that have these, the low words. Complements, so that they are largest numbers, and begin at 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"
#define SPAN_BINDING 3
#include "encode/encode_span.glsl"

layout(std430, binding = 4) buffer Ages { uint ages[]; };  // low and high words; zeros before

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  const uvec2 age = ~unpackUint2x32(last_time() - time_of(event));
  const uint value = polarity_plane(event) * push.width * push.height + pixel_of(event);
  if (push.mode == 0) atomicMax(ages[2 * value + 1], age.y);
  else if (ages[2 * value + 1] == age.y) atomicMax(ages[2 * value], age.x);
}
