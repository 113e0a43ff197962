// CHAIN-SAE, stage "count": how many stamps each word of the set has. A prefix sum over these follows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 1) writeonly buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint word = linear_index();
  if (word < push.words) counts[word] = bitCount(marks[word]);
}
