// SITS, stage "walk": one team takes the events of a submission in their order. For devices that are good at one thing
// at a time, and for submissions whose sweeps do not settle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "sits/sits_layout.h"
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kTeamX = 4;  // powers of two
layout(constant_id = 2) const uint kTeamY = 2;
const uint kTeamLanes = kTeamX * kTeamY;
#include "common/events.glsl"

layout(std430, binding = 1) buffer Values { uint64_t values[]; };             // two pixels each
layout(std430, binding = 2) readonly buffer Unsettled { uint unsettled[]; };  // per sweep
layout(push_constant) uniform Push { SitsPush pushed; };
SitsPush push = pushed;

// One word of 64 bits: on CPU devices a load costs the same whatever its width, but twice as much for a vector of two.
uint place_of(ivec2 pair) { return uint(pair.y) * push.pairs_x + uint(pair.x); }
ivec2 values_at(uint place) { return ivec2(unpackUint2x32(values[place])); }
void set_values(uint place, ivec2 pair) { values[place] = packUint2x32(uvec2(pair)); }
#include "sits/sits_team.glsl"

void main() {
  if (push.only_unsettled != 0 && unsettled[push.sweeps - 1] == 0) return;
  const ivec2 size = ivec2(push.width, push.height);
  // Trips: see sits_trips_per_block() in src/pipelines/sits/sits.cpp.
  for (uint block = 0; block < push.events; block += kTeamLanes) {
    const uint own_event = min(block + gl_SubgroupInvocationID, push.events - 1);
    const uint own_xy = event_at(push.first_event + own_event).z;
    const uint block_events = min(kTeamLanes, push.events - block);
    for (uint i = 0; i < block_events; ++i) {
      const uint xy = subgroupShuffle(own_xy, i);
      const ivec2 centre = ivec2(xy & 0xFFFF, xy >> 16);
      if (centre.x >= size.x || centre.y >= size.y) continue;
      fire(centre, centre_value(centre), max(centre - push.reach, 0), min(centre + push.reach, size - 1));
    }
  }
}
