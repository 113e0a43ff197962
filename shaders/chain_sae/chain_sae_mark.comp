// CHAIN-SAE, stage "mark": the set of stamps that pixels have, one bit each. No two pixels have the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Stamps { uint stamps[]; };
layout(std430, binding = 1) buffer Marks { uint marks[]; };  // zeros before
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  const uint stamp = stamps[pixel];
  if (stamp != 0) atomicOr(marks[stamp / 32], 1u << stamp % 32);
}
