// SCARF, stage "count": hits of each chunk of events on each patch.
// CPU twin: cpu_ref/stages/scarf_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "team.glsl"

void main() {
  const Lane lane = this_lane();
  if (lane.chunk >= push.chunks) return;
  const uint begin = lane.chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, push.events);
  // Trips: see trips_per_block() in src/scarf/plan.cpp.
  for (uint block = begin; block < end; block += kTeamLanes) {
    const Field own = field_of(position_of(block + lane.index, end));
    for (uint k = 0; k < kTeamLanes; ++k) {
      const uint columns = subgroupShuffle(own.columns, lane.team + k);
      const uint rows = subgroupShuffle(own.rows, lane.team + k);
      const uint first_i = first_owned(columns & 0xFFFF, lane.x, kTeamX);
      const uint first_j = first_owned(rows & 0xFFFF, lane.y, kTeamY);
      for (uint r = 0; r < kLaneRows; ++r) {
        const uint j = first_j + r * kTeamY;
        for (uint c = 0; c < kLaneColumns; ++c) {
          const uint i = first_i + c * kTeamX;
          const bool hit = i <= columns >> 16 && j <= rows >> 16;
          table[hit ? lane.base + j * push.grid_x + i : lane.unused_entry] += 1;
        }
      }
    }
  }
}
