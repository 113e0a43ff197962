// SCARF, stage "place": the chunks are walked again, and the hits that survive the batch are stored in their slots.
// CPU twin: cpu_ref/stages/scarf/scarf_place.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_8bit_storage : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/layout.h"
#include "common/team.glsl"
#include "scarf/scarf_hit.glsl"
#include "common/views.glsl"

WORDS_VIEW(1, RangesView, ranges)  // first | last << 16 per column, then row
IMAGE_VIEW(2, TableView, table)    // cursors per chunk and patch
layout(std430, binding = 3) writeonly buffer Slots { uint64_t slots[]; };
WORDS_VIEW(4, AliveView, alive)  // see scarf_prune.comp; valid if push.prune
layout(std430, binding = 5) writeonly buffer Positions { uint8_t positions[]; };  // per slot; see kNotShown

layout(constant_id = 5) const bool kPaints = true;  // the paint stage needs positions

// The hit of an event on patch (i, j), if that holds it. Nothing is masked: on CPU devices an unpredictable branch
// costs more than a store, so what is not to happen goes to an entry and a slot of the lane's own. The entry always
// holds kCursorDead.
void place_hit(Lane lane, uint i, uint j, Walked e) {
  const bool held = i <= e.columns >> 16 && j <= e.rows >> 16;
  const uint patch_id = j * push.grid_x + i;
  const uint entry = held ? lane.base + patch_id : push.unused_entry + lane.all;
  const uint cursor = IMAGE_WORD(table, entry);
  const bool stored = cursor < kCursorSkipOne;
  const uint next_slot = cursor + 1 == push.capacity ? 0 : cursor + 1;
  const uint next_skip = cursor == kCursorDead ? kCursorDead : cursor - kCursorSkipOne;
  SET_IMAGE_WORD(table, entry, stored ? next_slot : next_skip);
  // Each slot is written at most once per batch: the surviving ranks of a patch are distinct mod capacity.
  const uint slot = stored ? patch_id * push.capacity + cursor : push.unused_slot + lane.all;
  const uvec2 word = slot_of(e, i, j);
  slots[slot] = packUint2x32(word);
  if (kPaints) {
    // Eight bytes per lane, so that cores do not share a cache line.
    positions[stored ? patch_id * push.ring_bytes + cursor : push.unused_position + 8 * lane.all] =
        uint8_t(position_of(word));
  }
}

// The hits of an event on all patches that the lane owns. Small teams are spelled out: their loops would cost trips,
// see trips_per_block() in src/pipelines/scarf/plan.cpp.
void place_event(Lane lane, Walked e) {
  const uint i = first_owned(e.columns & 0xFFFF, lane.x, kTeamX);
  const uint j = first_owned(e.rows & 0xFFFF, lane.y, kTeamY);
  if (kLaneColumns == 1 && kLaneRows <= 2) {
    place_hit(lane, i, j, e);
    if (kLaneRows == 2) place_hit(lane, i, j + kTeamY, e);
    return;
  }
  for (uint r = 0; r < kLaneRows; ++r) {
    for (uint c = 0; c < kLaneColumns; ++c) place_hit(lane, i + c * kTeamX, j + r * kTeamY, e);
  }
}

uint range_at(uint entry) { return VIEW_WORD(ranges, entry); }

bool any_lane(bool value) { return subgroupBallot(value) != uvec4(0); }

void main() {
  if (is_beyond_teams()) return;  // a whole workgroup
  const Lane lane = this_lane();
  const bool has_chunk = lane.chunk < push.chunks;
  uint block = has_chunk ? lane.chunk * push.chunk_events : 0;
  const uint end = has_chunk ? min(block + push.chunk_events, push.events) : 0;
  const uint64_t t_first = packUint2x32(uvec2(push.t_first_low, push.t_first_high));
  const uint band_begin = lane.band * push.band_rows;
  const uint band_last = band_begin + push.band_rows - 1;
  // All teams of a subgroup leave a loop together, those that have nothing to do walk empty blocks: llvmpipe does not
  // keep what a loop computed for lanes that left it early. Loops end at their ends only, where a branch skips them on
  // CPU devices. Trips: see trips_per_block().
  do {
    // The next block of events, one per lane, of which any need be walked.
    Walked own;
    uint own_event;
    uint left;
    do {
      const bool in_chunk = block + lane.index < end;
      own_event = push.first_event + (in_chunk ? block + lane.index : 0);
      own.xy = event_at(own_event).z;
      own.columns = range_at(column_entry(own.xy));
      own.rows = range_at(row_entry(own.xy));
      const uvec2 first = uvec2(own.columns, own.rows) & 0xFFFF;
      const uvec2 last = uvec2(own.columns, own.rows) >> 16;
      const uint row_begin = max(first.y, band_begin);
      const uint row_last = min(last.y, band_last);
      bool walked = in_chunk && first.x <= last.x && row_begin <= row_last;
      if (push.prune != 0) {
        walked = walked && VIEW_WORD(alive, walked ? lane.base + first.y * push.grid_x + first.x : 0) != 0;
      }
      own.rows = row_begin | row_last << 16;
      left = team_ballot(lane, walked);
      block += kTeamLanes;
    } while (!any_lane(left != 0) && any_lane(block < end));
    const uvec4 event = event_at(own_event);
    own.word = unpackUint2x32(pack_time(packUint2x32(event.xy) - t_first) | pack_polarity(event.w & 1));
    // A team takes the events that are left in their order; when none are, an empty rectangle of patches.
    do {
      const uint source = lane.team + (left == 0 ? 0 : findLSB(left));
      Walked e;
      e.columns = subgroupShuffle(own.columns, source);
      e.rows = subgroupShuffle(own.rows, source);
      e.xy = subgroupShuffle(own.xy, source);
      e.word = subgroupShuffle(own.word, source);
      if (left == 0) e.columns = 0xFFFF;
      place_event(lane, e);
      left &= left - 1;
    } while (any_lane(left != 0));
  } while (any_lane(block < end));
}
