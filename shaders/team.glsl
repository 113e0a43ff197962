// Teams: the lanes that walk one chunk of events together.
//
// Lane (a, b) of a team owns the patches (i, j) with i = a mod kTeamX and j = b mod kTeamY. A (chunk, patch) entry of
// the table is thus read and written by one lane only, in the order of the events: no atomics, no barriers, and no
// assumption about subgroups. A power of two per axis.
layout(local_size_x_id = 0) in;
#include "invocation.glsl"

layout(constant_id = 1) const uint kTeamX = 4;
layout(constant_id = 2) const uint kTeamY = 2;
layout(constant_id = 3) const uint kLaneColumns = 1;  // columns of patches that a lane may own of one event
layout(constant_id = 4) const uint kLaneRows = 2;     // rows likewise

struct Lane {
  uint chunk;
  uint index;  // within the team
  uint x;
  uint y;
};

Lane this_lane() {
  const uint team_lanes = kTeamX * kTeamY;
  Lane lane;
  lane.chunk = linear_workgroup() * (gl_WorkGroupSize.x / team_lanes) + gl_LocalInvocationID.x / team_lanes;
  lane.index = gl_LocalInvocationID.x % team_lanes;
  lane.x = lane.index % kTeamX;
  lane.y = lane.index / kTeamX;
  return lane;
}

// First value >= first that is = lane mod team.
uint first_owned(uint first, uint lane, uint team) { return first + ((lane - first) & (team - 1)); }
