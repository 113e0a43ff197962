// CHAIN-SAE, rule event_driven, stage "begin": all pixels have fired once, in raster order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "chain_sae/chain_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) writeonly buffer Stamps { uint stamps[]; };
layout(push_constant) uniform Push { ChainPush pushed; };
ChainPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel < push.pixels) stamps[pixel] = pixel + 1;
}
