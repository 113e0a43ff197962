// SCARF, stage "place": the chunks are walked again, and the hits that survive the batch are stored in their slots.
// The count image follows: what a slot held is no longer shown, what it holds now is.
// CPU twin: cpu_ref/stages/scarf_place.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "layout.h"
#include "packed_event.glsl"
#include "team.glsl"
#include "active.glsl"

layout(std430, binding = 3) buffer Slots { uint64_t slots[]; };
layout(std430, binding = 4) readonly buffer Alive { uint alive[]; };  // see scarf_prune.comp; valid if push.prune
layout(std430, binding = 5) buffer Counts { int counts[]; };          // active stored events per pixel

// One hit of an event (x | y << 16, time and polarity packed) on patch (i, j).
void place_hit(Lane lane, uint i, uint j, uint xy, uvec2 word) {
  const uint patch_id = j * push.grid_x + i;
  const uint cursor = table[lane.base + patch_id];
  if (cursor >= kCursorSkipOne) {
    if (cursor != kCursorDead) table[lane.base + patch_id] = cursor - kCursorSkipOne;
    return;
  }
  table[lane.base + patch_id] = cursor + 1 == push.capacity ? 0 : cursor + 1;
  // Each slot is written at most once per batch: the surviving ranks of a patch are distinct mod capacity. So it holds
  // an event of an earlier batch, or none.
  const uint slot = patch_id * push.capacity + cursor;
  const uint64_t old = slots[slot];
  const uint field_x = uint(push.field_x) + i * push.cell_x;  // fields may begin outside the sensor and wrap,
  const uint field_y = uint(push.field_y) + j * push.cell_y;  // pixels of events never do
  const uint low_word = word.x | pack_position((xy & 0xFFFF) - field_x, (xy >> 16) - field_y);
  slots[slot] = packUint2x32(uvec2(low_word, word.y));
  const uint old_word = uint(old);
  if (old != kEmptySlot && is_active(old_word)) {
    atomicAdd(counts[(field_y + packed_y(old_word)) * push.width + field_x + packed_x(old_word)], -1);
  }
  if (is_active(low_word)) atomicAdd(counts[(xy >> 16) * push.width + (xy & 0xFFFF)], 1);
}

void main() {
  const Lane lane = this_lane();
  if (lane.chunk >= push.chunks) return;
  const uint begin = lane.chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, push.events);
  const uint64_t t_first = packUint2x32(uvec2(push.t_first_low, push.t_first_high));
  // Trips: see trips_per_block() in src/scarf/plan.cpp.
  for (uint block = begin; block < end; block += kTeamLanes) {
    const uint own_event = push.first_event + min(block + lane.index, end - 1);
    const uint own_xy = events[own_event].z;
    const Field own = field_of(own_xy);
    bool walked = block + lane.index < end && has_patches(own);
    if (push.prune != 0 && walked) {
      walked = alive[lane.base + (own.rows & 0xFFFF) * push.grid_x + (own.columns & 0xFFFF)] != 0;
    }
    uvec2 own_word = uvec2(0);
    if (walked) {
      const uvec4 event = events[own_event];
      own_word = unpackUint2x32(pack_time(packUint2x32(event.xy) - t_first) | pack_polarity(event.w & 1));
    }
    // The team takes the events that are left in their order.
    for (uint left = team_ballot(lane, walked); left != 0; left &= left - 1) {
      const uint source = lane.team + findLSB(left);
      const uint columns = subgroupShuffle(own.columns, source);
      const uint rows = subgroupShuffle(own.rows, source);
      const uint xy = subgroupShuffle(own_xy, source);
      const uvec2 word = subgroupShuffle(own_word, source);
      const uint first_i = first_owned(columns & 0xFFFF, lane.x, kTeamX);
      const uint first_j = first_owned(rows & 0xFFFF, lane.y, kTeamY);
      for (uint r = 0; r < kLaneRows; ++r) {
        const uint j = first_j + r * kTeamY;
        for (uint c = 0; c < kLaneColumns; ++c) {
          const uint i = first_i + c * kTeamX;
          if (i <= columns >> 16 && j <= rows >> 16) place_hit(lane, i, j, xy, word);
        }
      }
    }
  }
}
