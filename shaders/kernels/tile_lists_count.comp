// Tile lists, stage "count": how many events of each chunk belong to each tile. A count does not depend on order, so
// atomics are exact.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernels/tile_lists_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"
#include "kernels/tile_lists.glsl"

layout(std430, binding = 1) buffer Begins { uint begins[]; };  // per tile and chunk

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint xy = event_at(push.first_event + e).z;
  if (!is_inside(xy)) return;
  const Tiles tiles = tiles_of(xy);
  const uint chunk = e / push.chunk_events;
  // Trips: see place_trips() in src/kernels/tile_lists.cpp, which has these loops too.
  for (uint row = tiles.top; row <= tiles.bottom; ++row) {
    for (uint column = tiles.left; column <= tiles.right; ++column) {
      atomicAdd(begins[(row * push.tiles_x + column) * push.chunks + chunk], 1);
    }
  }
}
