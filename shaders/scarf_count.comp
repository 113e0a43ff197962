// SCARF, stage "count": hits of each chunk of events on each patch.
// CPU twin: cpu_ref/stages/scarf_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "team.glsl"

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Ranges { uint ranges[]; };   // first | last << 16 per column, then row
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };        // zeros before
layout(push_constant) uniform Push { BatchPush push; };

void main() {
  const Lane lane = this_lane();
  if (lane.chunk >= push.chunks) return;
  const uint base = lane.chunk * push.table_stride;
  const uint unused_entry = base + push.table_stride - kTeamX * kTeamY + lane.index;
  const uint begin = lane.chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, push.events);
  // Trips: see chunk_loop_trips() in src/scarf/plan.cpp.
  for (uint e = begin; e < end; ++e) {
    const uint xy = events[push.first_event + e].z;
    const uint columns = ranges[min(xy & 0xFFFF, push.width)];
    const uint rows = ranges[push.width + 1 + min(xy >> 16, push.height)];
    const uint first_i = first_owned(columns & 0xFFFF, lane.x, kTeamX);
    const uint first_j = first_owned(rows & 0xFFFF, lane.y, kTeamY);
    for (uint r = 0; r < kLaneRows; ++r) {
      const uint j = first_j + r * kTeamY;
      for (uint c = 0; c < kLaneColumns; ++c) {
        const uint i = first_i + c * kTeamX;
        const bool hit = i <= columns >> 16 && j <= rows >> 16;
        table[hit ? base + j * push.grid_x + i : unused_entry] += 1;
      }
    }
  }
}
