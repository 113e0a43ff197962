// SCARF, stage "place": the chunks are walked again, and the hits that survive the batch are stored in their slots.
// CPU twin: cpu_ref/stages/scarf_place.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "layout.h"
#include "packed_event.glsl"
#include "team.glsl"

layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Ranges { uint ranges[]; };
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };        // cursors
layout(std430, binding = 3) writeonly buffer Slots { uint64_t slots[]; };
layout(push_constant) uniform Push { BatchPush push; };

void main() {
  const Lane lane = this_lane();
  if (lane.chunk >= push.chunks) return;
  const uint base = lane.chunk * push.table_stride;
  const uint unused_entry = base + push.table_stride - kTeamX * kTeamY + lane.index;
  const uint unused_slot = push.unused_slot + lane.chunk * kTeamX * kTeamY + lane.index;
  const uint begin = lane.chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, push.events);
  const uint64_t t_first = packUint2x32(uvec2(push.t_first_low, push.t_first_high));
  // Trips: see chunk_loop_trips() in src/scarf/plan.cpp.
  for (uint e = begin; e < end; ++e) {
    const uvec4 event = events[push.first_event + e];
    const uint x = event.z & 0xFFFF;
    const uint y = event.z >> 16;
    const uint columns = ranges[min(x, push.width)];
    const uint rows = ranges[push.width + 1 + min(y, push.height)];
    const uint first_i = first_owned(columns & 0xFFFF, lane.x, kTeamX);
    const uint first_j = first_owned(rows & 0xFFFF, lane.y, kTeamY);
    const uint64_t t_and_p = pack_time(packUint2x32(event.xy) - t_first) | pack_polarity(event.w & 1);
    for (uint r = 0; r < kLaneRows; ++r) {
      const uint j = first_j + r * kTeamY;
      for (uint c = 0; c < kLaneColumns; ++c) {
        const uint i = first_i + c * kTeamX;
        const bool hit = i <= columns >> 16 && j <= rows >> 16;
        const uint patch_id = j * push.grid_x + i;
        const uint entry = hit ? base + patch_id : unused_entry;
        const uint cursor = table[entry];
        const bool survives = cursor < kCursorSkipOne;
        const uint next = cursor + 1 == push.capacity ? 0 : cursor + 1;
        table[entry] = survives ? next : cursor - kCursorSkipOne;
        // Each slot is written at most once per batch: the surviving ranks of a patch are distinct mod capacity.
        slots[hit && survives ? patch_id * push.capacity + cursor : unused_slot] =
            t_and_p | pack_position(x - push.field_x - i * push.cell_x, y - push.field_y - j * push.cell_y);
      }
    }
  }
}
