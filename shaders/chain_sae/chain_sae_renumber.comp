// CHAIN-SAE, stage "renumber": the stamps become consecutive, so that there is room for more.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Ranks { uint ranks[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };  // in the end, the number of all stamps
layout(std430, binding = 2) writeonly buffer Stamps { uint stamps[]; };
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel >= push.pixels) return;
  const uint rank = ranks[pixel];
  stamps[pixel] = rank == push.pixels ? 0 : counts[push.words] - rank;
}
