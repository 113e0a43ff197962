// Replay, stage "rank": the rank of each event among the hits of its own patch, the one in whose cell it is. One team of
// lanes per chunk walks it in order; for each patch that holds an event, one lane reads the number of hits and raises
// it. Afterwards the table has the number of hits by the end of each chunk.
// Lane (a, b) of a team owns the patches (i, j) with i = a mod kTeamX and j = b mod kTeamY: no other lane touches them,
// so there are no atomics and no barriers. A team lies within one subgroup, whose size the pipeline requires.
// CPU twin: cpu_ref/stages/replay/replay_rank.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "replay/replay_layout.h"
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kTeamX = 4;  // powers of two
layout(constant_id = 2) const uint kTeamY = 2;
layout(constant_id = 3) const uint kLaneColumns = 1;  // columns of patches that a lane may own of one event
layout(constant_id = 4) const uint kLaneRows = 2;     // rows likewise
const uint kTeamLanes = kTeamX * kTeamY;
#include "replay/replay.glsl"
#include "replay/replay_ranges.glsl"
#include "common/first_owned.glsl"
#include "common/views.glsl"

IMAGE_VIEW(2, TableView, table)  // per chunk and patch
layout(std430, binding = 4) writeonly buffer Ranks { uint ranks[]; };

void main() {
  const uint invocation = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
  const uint chunk = linear_workgroup() * (gl_WorkGroupSize.x / kTeamLanes) + invocation / kTeamLanes;
  if (chunk >= push.chunks) return;
  const uint lane = gl_SubgroupInvocationID % kTeamLanes;
  const uint team = gl_SubgroupInvocationID - lane;
  const uint base = chunk * push.stride;
  const uint waste = base + push.patches + lane;  // a masked load costs more than one that nobody needs
  const uint end = chunk_begin(chunk + 1);
  // Trips: see rank_trips() in src/pipelines/replay/plan.cpp.
  for (uint block = chunk_begin(chunk); block < end; block += kTeamLanes) {
    const uint own = block + lane;
    const uint xy = event_at(min(own, end - 1));
    const uint own_columns = own < end ? columns_of(xy) : 1;  // 1: from 1 to 0, none
    const uint own_rows = rows_of(xy);
    const uint own_patch = owner_of(xy);
    uint own_rank = 0;
    for (uint source = 0; source < kTeamLanes; ++source) {
      const uint columns = subgroupShuffle(own_columns, team + source);
      const uint rows = subgroupShuffle(own_rows, team + source);
      const uint wanted = subgroupShuffle(own_patch, team + source);
      const uint first_i = first_owned(columns & 0xFFFF, lane % kTeamX, kTeamX);
      const uint first_j = first_owned(rows & 0xFFFF, lane / kTeamX, kTeamY);
      uint found = 0;
      for (uint r = 0; r < kLaneRows; ++r) {
        const uint j = first_j + r * kTeamY;
        for (uint c = 0; c < kLaneColumns; ++c) {
          const uint i = first_i + c * kTeamX;
          const uint entry = i <= columns >> 16 && j <= rows >> 16 ? base + j * push.grid_x + i : waste;
          const uint hits = IMAGE_WORD(table, entry);
          SET_IMAGE_WORD(table, entry, hits + 1);
          if (wanted == (i | j << 16)) found = hits;
        }
      }
      // An event lies in the field of its own patch, so the lane that owns it has found the rank.
      const uint finder = (wanted & 0xFFFF) % kTeamX + (wanted >> 16) % kTeamY * kTeamX;
      const uint rank = subgroupShuffle(found, team + finder);
      if (lane == source) own_rank = rank;
    }
    if (own < end) ranks[own] = own_rank;
  }
}
