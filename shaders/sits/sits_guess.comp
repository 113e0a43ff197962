// SITS, stage "guess": the value at the centre of each event before the submission, from which the sweeps start. Any
// guess leads to the same values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "sits/sits_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) readonly buffer Values { int values[]; };
layout(std430, binding = 2) writeonly buffer Centres { int centres[]; };
layout(push_constant) uniform Push { SitsPush pushed; };
SitsPush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint xy = event_at(push.first_event + e).z;
  const uint x = xy & 0xFFFF;
  const uint y = xy >> 16;
  centres[e] = x < push.width && y < push.height ? values[y * 2 * push.pairs_x + x] : 0;
}
