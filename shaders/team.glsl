// Teams: the lanes that walk one chunk of events together.
//
// Lane (a, b) of a team owns the patches (i, j) with i = a mod kTeamX and j = b mod kTeamY. A (chunk, patch) entry of
// the table is thus read and written by one lane only, in the order of the events: no atomics and no barriers.
// A team lies within one subgroup, whose size the pipeline requires: each lane loads one of the next events, and the
// team then takes them one by one, by shuffles.
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(local_size_x_id = 0) in;
#include "invocation.glsl"

layout(constant_id = 1) const uint kTeamX = 4;        // powers of two
layout(constant_id = 2) const uint kTeamY = 2;
layout(constant_id = 3) const uint kLaneColumns = 1;  // columns of patches that a lane may own of one event
layout(constant_id = 4) const uint kLaneRows = 2;     // rows likewise
const uint kTeamLanes = kTeamX * kTeamY;

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Ranges { uint ranges[]; };   // first | last << 16 per column, then row
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };        // counts or cursors per chunk and patch
layout(push_constant) uniform Push { BatchPush push; };

struct Lane {
  uint chunk;
  uint index;         // within the team
  uint team;          // subgroup invocation of the team's first lane
  uint x;
  uint y;
  uint base;          // first entry of the chunk's table
  uint unused_entry;  // where this lane counts what is not a hit: cheaper than a branch
};

Lane this_lane() {
  Lane lane;
  const uint invocation = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
  lane.chunk = linear_workgroup() * (gl_WorkGroupSize.x / kTeamLanes) + invocation / kTeamLanes;
  lane.index = gl_SubgroupInvocationID % kTeamLanes;
  lane.team = gl_SubgroupInvocationID - lane.index;
  lane.x = lane.index % kTeamX;
  lane.y = lane.index / kTeamX;
  lane.base = lane.chunk * push.table_stride;
  lane.unused_entry = lane.base + push.table_stride - kTeamLanes + lane.index;
  return lane;
}

// The patches that hold an event: first | last << 16 of the columns and of the rows.
struct Field {
  uint columns;
  uint rows;
};

// Position of event e of the batch, as x | y << 16; behind the chunk's end one that no patch holds.
uint position_of(uint e, uint end) {
  const uint xy = events[push.first_event + min(e, end - 1)].z;
  return e < end ? xy : 0xFFFFFFFFu;
}

Field field_of(uint xy) {
  return Field(ranges[min(xy & 0xFFFF, push.width)], ranges[push.width + 1 + min(xy >> 16, push.height)]);
}

// First value >= first that is = lane mod team.
uint first_owned(uint first, uint lane, uint team) { return first + ((lane - first) & (team - 1)); }
