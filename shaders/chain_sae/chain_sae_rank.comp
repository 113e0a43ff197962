// CHAIN-SAE, stage "rank": the rank of a pixel is the number of larger stamps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Stamps { uint stamps[]; };
layout(std430, binding = 1) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 2) readonly buffer Counts { uint counts[]; };  // stamps in the words before; in the end, all
layout(std430, binding = 3) writeonly buffer Ranks { uint ranks[]; };   // 0: newest; push.pixels: never fired
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  const uint stamp = stamps[pixel];
  uint rank = push.pixels;
  if (stamp != 0) {
    const uint smaller = bitCount(marks[stamp / 32] & (1u << stamp % 32) - 1);
    rank = counts[push.words] - counts[stamp / 32] - smaller - 1;
  }
  ranks[pixel] = rank;
}
