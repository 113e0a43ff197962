// Measures a device: one integer atomic per invocation, at addresses without an order, results unused: as the stages
// that count use them. No pipeline uses it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) buffer Table { uint table[]; };
layout(push_constant) uniform Push { CeilingPush pushed; };
CeilingPush push = pushed;

void main() {
  const uint i = linear_index();
  // Knuth's multiplicative hash.
  if (i < push.invocations) atomicAdd(table[(i * 2654435761u) >> (32 - push.address_bits)], 1);
}
