// Teams: the lanes that walk one chunk of events together.
//
// Lane (a, b) of a team owns the patches (i, j) with i = a mod kTeamX and j = b mod kTeamY. A (chunk, patch) entry of
// the table is thus read and written by one lane only, in the order of the events: no atomics and no barriers.
// A team lies within one subgroup, whose size the pipeline requires: each lane loads one of the next events, and the
// team then takes them one by one, by shuffles.
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(local_size_x_id = 0) in;
#include "common/invocation.glsl"

layout(constant_id = 1) const uint kTeamX = 4;        // powers of two
layout(constant_id = 2) const uint kTeamY = 2;
layout(constant_id = 3) const uint kLaneColumns = 1;  // columns of patches that a lane may own of one event
layout(constant_id = 4) const uint kLaneRows = 2;     // rows likewise
const uint kTeamLanes = kTeamX * kTeamY;

#include "common/batch.glsl"

struct Lane {
  uint chunk;
  uint band;
  uint index;  // within the team
  uint team;   // subgroup invocation of the team's first lane
  uint x;
  uint y;
  uint base;   // first entry of the chunk's table
  uint all;    // number among the lanes of all teams
};

// Consecutive teams may go to the same core, and the last chunks may have the most work. So every core gets a stripe of
// chunks: the teams of stripe n take the chunks n, n + stripes, n + 2 * stripes, ...
//
// Where all rings together do not fit into a core's cache, a team stores in one band of rows of patches only, and other
// teams walk the same chunk for the other bands. A core takes all chunks of its stripe for one band, then for the next,
// and each core begins with another band.
uint chunks_per_stripe() { return (push.chunks + push.stripes - 1) / push.stripes; }

void take_work(uint team, inout Lane lane) {
  const uint per_stripe = chunks_per_stripe();
  const uint stripe = team / (per_stripe * push.bands);  // the last workgroup may have teams beyond the last
  const uint turn = team % (per_stripe * push.bands);
  lane.chunk = stripe < push.stripes ? turn % per_stripe * push.stripes + stripe : push.chunks;
  lane.band = (turn / per_stripe + stripe * push.bands / push.stripes) % push.bands;
}

uint teams_of_workgroup() { return gl_WorkGroupSize.x / kTeamLanes; }

// Whether this workgroup has no team at all, and hence no unused entries and slots of its own.
bool is_beyond_teams() {
  return linear_workgroup() * teams_of_workgroup() >= push.stripes * push.bands * chunks_per_stripe();
}

Lane this_lane() {
  Lane lane;
  const uint invocation = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
  const uint team = linear_workgroup() * teams_of_workgroup() + invocation / kTeamLanes;
  take_work(team, lane);
  lane.index = gl_SubgroupInvocationID % kTeamLanes;
  lane.team = gl_SubgroupInvocationID - lane.index;
  lane.x = lane.index % kTeamX;
  lane.y = lane.index / kTeamX;
  lane.base = lane.chunk * push.patches;
  lane.all = team * kTeamLanes + lane.index;
  return lane;
}

// One bit per lane of the team, the first lane's lowest. Teams have at most 32 lanes, all in one word of a ballot.
uint team_ballot(Lane lane, bool value) {
  return subgroupBallot(value)[lane.team / 32] >> lane.team % 32 & 0xFFFFFFFFu >> 32 - kTeamLanes;
}
