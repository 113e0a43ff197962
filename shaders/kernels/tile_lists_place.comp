// Tile lists, stage "place": each event goes to its place in the lists of its tiles. The place is where the part of its
// chunk begins, plus the number of events before it in the chunk that belong to the tile: nothing depends on who comes
// first, and each place is written once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernels/tile_lists_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"
#include "kernels/tile_lists.glsl"

layout(std430, binding = 1) readonly buffer Begins { uint begins[]; };  // per tile and chunk: place of its first event
layout(std430, binding = 2) writeonly buffer Lists { uint lists[]; };

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint xy = event_at(push.first_event + e).z;
  if (!is_inside(xy)) return;
  const Tiles tiles = tiles_of(xy);
  const uint chunk = e / push.chunk_events;
  // Trips: see place_trips() in src/kernels/tile_lists.cpp.
  for (uint row = tiles.top; row <= tiles.bottom; ++row) {
    for (uint column = tiles.left; column <= tiles.right; ++column) {
      uint place = begins[(row * push.tiles_x + column) * push.chunks + chunk];
      for (uint other = chunk * push.chunk_events; other < e; ++other) {
        const uint other_xy = event_at(push.first_event + other).z;
        if (is_inside(other_xy) && holds(column, row, other_xy)) ++place;
      }
      lists[place] = e;
    }
  }
}
