// SITS, stage "sweep": each tile replays the events of its list, one team per tile. What an event does to a tile
// depends on the value at its centre. Where the centre lies in another tile, the value is what that tile found in the
// sweep before. The sweeps have settled when one finds what the one before it found. Going through the events in their
// order, each of these values is then the true one, because it follows from true values of earlier events only. A tile
// whose neighbours found nothing new would find nothing new itself, and is skipped.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "sits/sits_layout.h"
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kTeamX = 8;  // powers of two
layout(constant_id = 2) const uint kTeamY = 4;
layout(constant_id = 3) const uint kTile = 32;  // pixels per side, a multiple of 2 * kTeamX and of kTeamY
const uint kTeamLanes = kTeamX * kTeamY;
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) readonly buffer Begins { uint begins[]; };  // see TileLists
layout(std430, binding = 2) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 3) readonly buffer Values { ivec2 values[]; };  // two pixels each, before the submission
layout(std430, binding = 4) writeonly buffer Swept { ivec2 swept[]; };   // after it, once settled
layout(std430, binding = 5) readonly buffer CentresBefore { int centres_before[]; };  // per event, of the sweep before
layout(std430, binding = 6) writeonly buffer Centres { int centres[]; };  // of events that other tiles look at
// Per sweep, whether it found anything new; then per tile, whether it did in even sweeps; then in odd ones.
layout(std430, binding = 7) buffer Unsettled { uint unsettled[]; };
layout(push_constant) uniform Push { SitsPush pushed; };
SitsPush push = pushed;

// Rows are longer by a row of lanes, so that the lanes of a team are in different banks of the shared memory.
const uint kPairs = kTile / 2;
const uint kRow = kPairs + kTeamX;
shared ivec2 tile_values[kTile * kRow];

uint place_of(ivec2 pair) { return uint(pair.y) % kTile * kRow + uint(pair.x) % kPairs; }
ivec2 values_at(uint place) { return tile_values[place]; }
void set_values(uint place, ivec2 pair) { tile_values[place] = pair; }
#include "sits/sits_team.glsl"

struct Tile {
  uint index;
  ivec2 first;  // pixels
  ivec2 last;
  uint begin;   // of its list
  uint end;
};

Tile this_tile(uint index) {
  const ivec2 first = ivec2(index % push.tiles_x, index / push.tiles_x) * int(kTile);
  const ivec2 last = min(first + int(kTile), ivec2(push.width, push.height)) - 1;
  return Tile(index, first, last, begins[index * push.chunks], begins[(index + 1) * push.chunks]);
}

bool in_tile(Tile tile, ivec2 pixel) {
  return all(greaterThanEqual(pixel, tile.first)) && all(lessThanEqual(pixel, tile.last));
}

// Whether another tile may have the event of this pixel in its list.
bool is_shared(Tile tile, ivec2 pixel) {
  return any(lessThan(pixel - push.reach, tile.first)) || any(greaterThan(pixel + push.reach, tile.last));
}

uint found_new(uint tile, uint sweep) {
  return unsettled[push.sweeps + (sweep & 1) * push.tiles_x * push.tiles_y + tile];
}
void set_found_new(uint tile, bool found) {
  if (gl_SubgroupInvocationID != 0) return;
  unsettled[push.sweeps + (push.sweep & 1) * push.tiles_x * push.tiles_y + tile] = found ? 1 : 0;
  if (found) atomicOr(unsettled[push.sweep], 1);
}

// Whether a tile with a centre that this one looks at found anything new in the sweep before. Trips: at most 9 tiles
// per axis, and an entry each.
bool neighbours_found_new(Tile tile) {
  const ivec2 size = ivec2(push.width, push.height);
  const uvec2 low = uvec2(max(tile.first - push.reach, 0)) / kTile;
  const uvec2 high = uvec2(min(tile.last + push.reach, size - 1)) / kTile;
  uint found = 0;
  for (uint row = low.y; row <= high.y; ++row) {
    for (uint column = low.x; column <= high.x; ++column) {
      const uint other = row * push.tiles_x + column;
      if (other != tile.index) found |= found_new(other, push.sweep - 1);
    }
  }
  return found != 0;
}

// The i-th pair of a lane in its tile.
ivec2 own_pair(Tile tile, uint i) {
  const uint columns = kPairs / kTeamX;
  return pair_of(tile.first) + lane_position() + ivec2(i % columns * kTeamX, i / columns * kTeamY);
}
const uint kOwnPairs = kTile * kPairs / kTeamLanes;

bool has_pair(Tile tile, ivec2 pair) { return 2 * pair.x <= tile.last.x && pair.y <= tile.last.y; }

void load_values(Tile tile) {
  // Trips: kOwnPairs.
  for (uint i = 0; i < kOwnPairs; ++i) {
    const ivec2 pair = own_pair(tile, i);
    if (has_pair(tile, pair)) set_values(place_of(pair), values[uint(pair.y) * push.pairs_x + uint(pair.x)]);
  }
}

void store_values(Tile tile) {
  // Trips: kOwnPairs.
  for (uint i = 0; i < kOwnPairs; ++i) {
    const ivec2 pair = own_pair(tile, i);
    if (has_pair(tile, pair)) swept[uint(pair.y) * push.pairs_x + uint(pair.x)] = values_at(place_of(pair));
  }
}

// Returns whether the lane saw anything new.
bool replay(Tile tile) {
  bool found = false;
  // Trips: see sits_trips_per_block() in src/pipelines/sits/sits.cpp.
  for (uint block = tile.begin; block < tile.end; block += kTeamLanes) {
    const uint own = block + gl_SubgroupInvocationID;
    const uint own_event = lists[min(own, tile.end - 1)];
    const uint own_xy = event_at(push.first_event + own_event).z;
    const int own_before = centres_before[own_event];
    int own_centre = own_before;
    const uint block_events = min(kTeamLanes, tile.end - block);
    for (uint i = 0; i < block_events; ++i) {
      const uint xy = subgroupShuffle(own_xy, i);
      const ivec2 centre = ivec2(xy & 0xFFFF, xy >> 16);
      int value = subgroupShuffle(own_before, i);
      if (in_tile(tile, centre)) {
        value = centre_value(centre);
        if (i == gl_SubgroupInvocationID) own_centre = value;
      }
      fire(centre, value, max(centre - push.reach, tile.first), min(centre + push.reach, tile.last));
    }
    const ivec2 pixel = ivec2(own_xy & 0xFFFF, own_xy >> 16);
    if (own < tile.end && in_tile(tile, pixel) && is_shared(tile, pixel)) {
      centres[own_event] = own_centre;
      found = found || own_centre != own_before;
    }
  }
  return found;
}

// What the tile found in the sweep before holds in this one too.
void keep_centres(Tile tile) {
  // Trips: as replay(), without its inner loops.
  for (uint own = tile.begin + gl_SubgroupInvocationID; own < tile.end; own += kTeamLanes) {
    const uint own_event = lists[own];
    const uint xy = event_at(push.first_event + own_event).z;
    const ivec2 pixel = ivec2(xy & 0xFFFF, xy >> 16);
    if (in_tile(tile, pixel) && is_shared(tile, pixel)) centres[own_event] = centres_before[own_event];
  }
}

void main() {
  const uint index = linear_workgroup();
  if (index >= push.tiles_x * push.tiles_y) return;
  if (push.sweep > 0 && unsettled[push.sweep - 1] == 0) return;
  const Tile tile = this_tile(index);
  if (tile.begin == tile.end) return;
  if (push.sweep > 0 && !neighbours_found_new(tile)) {
    // If it found nothing new, both sweeps' centres are the same already.
    if (found_new(index, push.sweep - 1) != 0) keep_centres(tile);
    set_found_new(index, false);
    return;
  }
  load_values(tile);
  const bool found = replay(tile);
  set_found_new(index, subgroupBallot(found) != uvec4(0));
  store_values(tile);
}
