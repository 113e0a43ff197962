// SCARF, stage "append": events are stored in their order, from the rings' heads on, instead of count, sum, scan and
// place. For devices of few cores: each subgroup goes through all events, for patches that are its alone.
// CPU twin: cpu_ref/stages/scarf/scarf_append.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_8bit_storage : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "common/layout.h"
layout(local_size_x_id = 0) in;  // one subgroup
#include "common/invocation.glsl"

layout(constant_id = 1) const uint kTeamX = 4;        // powers of two: lanes of an event
layout(constant_id = 2) const uint kTeamY = 2;
layout(constant_id = 3) const uint kLaneColumns = 1;  // columns of patches that a lane may own of one event
layout(constant_id = 4) const uint kLaneRows = 1;     // rows likewise
layout(constant_id = 5) const bool kPaints = true;    // the paint stage needs positions
layout(constant_id = 6) const uint kTeams = 1;        // events at a time, at most the capacity; see append_hit()
const uint kTeamLanes = kTeamX * kTeamY;
// Events that are read together: bits of a word of a ballot.
const uint kBlock = gl_WorkGroupSize.x < 32 ? gl_WorkGroupSize.x : 32;

#include "common/events.glsl"
#include "common/views.glsl"

COHERENT_IMAGE_VIEW(1, HeadsView, heads)  // see ring_head.glsl, append_hit()
layout(std430, binding = 2) writeonly buffer Slots { uint64_t slots[]; };
layout(std430, binding = 3) writeonly buffer Positions { uint8_t positions[]; };  // per slot; see kNotShown
layout(push_constant) uniform Push { AppendPush pushed; };
AppendPush push = pushed;
#include "common/ring_head.glsl"
#include "scarf/scarf_hit.glsl"

uint parts() { return 1u << push.parts_shift; }

// Part n of the patches: every parts-th row, from row n on, and of these a band, whose rings fit into a core's
// cache. The rows of a part are numbered by themselves: its row k is row k * parts + n of the grid. Nearly every event
// has patches in all parts, so that cores have the same work wherever the events are.
struct Part {
  uint first_row;
  uint band_begin;
  uint band_last;
};

Part this_part() {
  // Consecutive workgroups may go to the same core: it takes a part's bands one after the other, and each core begins
  // with another band.
  const uint part = linear_workgroup() / push.bands;
  const uint band = (linear_workgroup() + part * push.bands / parts()) % push.bands;
  return Part(part, band * push.band_rows, (band + 1) * push.band_rows - 1);
}

// Exact for numbers below 2^22, divisors up to 128 and inverse = ceil(2^31 / divisor).
uint divide(uint number, uint inverse) {
  uint high, low;
  umulExtended(2 * number, inverse, high, low);
  return high;
}

// Patches whose fields hold the pixel at a distance from where the first field begins: GridAxis::patches_holding.
uvec2 holders(uint distance, uint overlap, uint inverse, uint grid) {
  return uvec2(distance < overlap ? 0 : divide(distance - overlap, inverse), min(divide(distance, inverse), grid - 1));
}

// An event and its rectangle of patches; 0xFFFF | 0 << 16 for columns where this part has none of them.
Walked walk(uint index, Part part) {
  const uvec4 event = event_at(push.first_event + (index < push.events ? index : 0));
  const uint64_t t_first = packUint2x32(uvec2(push.t_first_low, push.t_first_high));
  const uint x = event.z & 0xFFFF;
  const uint y = event.z >> 16;
  const uint from_field_x = x - uint(push.field_x);
  const uint from_field_y = y - uint(push.field_y);
  const uvec2 columns = holders(from_field_x, push.overlap_x, push.inverse_x, push.grid_x);
  const uvec2 rows = holders(from_field_y, push.overlap_y, push.inverse_y, push.grid_y);
  const uint k_first = rows.x + parts() - 1 - part.first_row >> push.parts_shift;
  const uint k_end = rows.y + parts() - part.first_row >> push.parts_shift;  // one more than the last
  const uint begin = max(k_first, part.band_begin);
  const uint end = min(k_end, part.band_last + 1);
  const bool held = index < push.events && x < push.width && y < push.height && int(from_field_x) >= 0 &&
                    int(from_field_y) >= 0 && columns.x <= columns.y && begin < end;
  Walked e;
  e.columns = held ? columns.x | columns.y << 16 : 0xFFFF;
  e.rows = begin | end - 1 << 16;
  e.xy = event.z;
  e.word = unpackUint2x32(pack_time(packUint2x32(event.xy) - t_first) | pack_polarity(event.w & 1));
  return e;
}

// The hit of an event on patch (i, row k of the part), if that holds it. Nothing is masked: on CPU devices an
// unpredictable branch costs more than a store, so what is not to happen goes to a head and a slot of the lane's own.
//
// A team of lanes takes one event; where a subgroup has several teams, they take consecutive events in the same step.
// Lanes with the same number in their teams own the same patches. Those that store in the same one, as they can see, take
// consecutive slots, and the last of them moves the head. That the next step finds the head moved counts on lanes that go
// in step: see Quirks::lanes_in_step in src/vulkan/quirks.h.
void append_hit(uint lane, uint part_row, uint i, uint k, Walked e) {
  const bool held = i <= e.columns >> 16 && k <= e.rows >> 16;
  const uint j = (k << push.parts_shift) + part_row;
  const uint patch_id = held ? j * push.grid_x + i : 0xFFFFFFFF;
  const uint unused = linear_workgroup() * gl_WorkGroupSize.x + lane;
  const uint unused_head = push.grid_x * push.grid_y + unused;
  const uint team = lane / kTeamLanes;
  uint before = 0;
  bool last = held;
  for (uint n = 1; n < kTeams; ++n) {
    // Never beyond the subgroup: LLVM 15 crashes on such a lane where it knows the number beforehand.
    const uint distance = n * kTeamLanes;
    const uint earlier = subgroupShuffle(patch_id, max(lane, distance) - distance);
    const uint later = subgroupShuffle(patch_id, min(lane + distance, gl_WorkGroupSize.x - 1));
    before += team >= n && earlier == patch_id ? 1 : 0;
    last = last && !(team + n < kTeams && later == patch_id);
  }
  const uint head = IMAGE_WORD(heads, held ? patch_id : unused_head);
  const uint next = head_slot(head) + before;
  const uint slot = next < push.capacity ? next : next - push.capacity;
  const uint lap = next + 1 < push.capacity ? 0 : kHeadLap - push.capacity;
  SET_IMAGE_WORD(heads, last ? patch_id : unused_head, head + (before + 1 + lap));
  const uvec2 word = slot_of(e, i, j);
  slots[held ? patch_id * push.capacity + slot : push.unused_slot + unused] = packUint2x32(word);
  if (kPaints) {
    // Eight bytes per lane, so that cores do not share a cache line.
    positions[held ? patch_id * push.ring_bytes + slot : push.unused_position + 8 * unused] =
        uint8_t(position_of(word));
  }
}

void append_event(uint lane, uint part_row, Walked e) {
  const uint i = first_owned(e.columns & 0xFFFF, lane % kTeamX, kTeamX);
  const uint k = first_owned(e.rows & 0xFFFF, lane % kTeamLanes / kTeamX, kTeamY);
  if (kLaneColumns == 1 && kLaneRows <= 2) {
    append_hit(lane, part_row, i, k, e);
    if (kLaneRows == 2) append_hit(lane, part_row, i, k + kTeamY, e);
    return;
  }
  for (uint r = 0; r < kLaneRows; ++r) {
    for (uint c = 0; c < kLaneColumns; ++c) append_hit(lane, part_row, i + c * kTeamX, k + r * kTeamY, e);
  }
}

void main() {
  if (linear_workgroup() >= parts() * push.bands) return;  // beyond the last: no part, and no unused entries
  const Part part = this_part();
  const uint lane = gl_SubgroupInvocationID;
  uint block = 0;
  // Loops end at their ends only, where a branch skips them on CPU devices. Trips: see trips_per_block() in
  // src/pipelines/scarf/plan.cpp.
  do {
    const Walked own = walk(lane < kBlock ? block + lane : push.events, part);
    uint left = subgroupBallot(own.columns != 0xFFFF).x;
    do {
      // The next kTeams of the events that are left, one for each team.
      uint mine = left;
      left &= left - 1;
      for (uint n = 1; n < kTeams; ++n) {
        mine = lane / kTeamLanes >= n ? left : mine;
        left &= left - 1;
      }
      if (lane / kTeamLanes >= kTeams) mine = 0;
      const uint source = mine == 0 ? 0 : findLSB(mine);
      Walked e;
      e.columns = subgroupShuffle(own.columns, source);
      e.rows = subgroupShuffle(own.rows, source);
      e.xy = subgroupShuffle(own.xy, source);
      e.word = subgroupShuffle(own.word, source);
      if (mine == 0) e.columns = 0xFFFF;
      append_event(lane, part.first_row, e);
    } while (left != 0);
    block += kBlock;
  } while (block < push.events);
}
