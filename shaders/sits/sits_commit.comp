// SITS, stage "commit": the values that the sweeps found become the values, if the sweeps settled.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "sits/sits_layout.h"
layout(local_size_x = kLinearGroup) in;
layout(constant_id = 0) const uint kTile = 32;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Begins { uint begins[]; };
layout(std430, binding = 1) readonly buffer Swept { ivec2 swept[]; };
layout(std430, binding = 2) writeonly buffer Values { ivec2 values[]; };
layout(std430, binding = 3) readonly buffer Unsettled { uint unsettled[]; };
layout(push_constant) uniform Push { SitsPush pushed; };
SitsPush push = pushed;

void main() {
  const uint pair = linear_index();
  if (pair >= push.pairs_x * push.height || unsettled[push.sweeps - 1] != 0) return;
  const uint tile = pair / push.pairs_x / kTile * push.tiles_x + pair % push.pairs_x * 2 / kTile;
  // Tiles without events were not swept.
  if (begins[tile * push.chunks] != begins[(tile + 1) * push.chunks]) values[pair] = swept[pair];
}
