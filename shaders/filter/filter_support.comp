// Noise filter "support": an event passes if a pixel of its window fired with its polarity shortly before.
// A tile keeps the last times of its pixels and of those around it that its windows reach. Its list has their events
// too, so tiles need nothing of each other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter/filter_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "filter/filter.glsl"

// `corner`: the first entry of the event's window. Pixels outside the sensor never fire.
bool has_support(uint corner, uint side, int64_t t) {
  bool supported = false;
  // Trips: at most 2 * range + 1 rows of as many pixels and an entry each; see trips_per_event() in
  // src/pipelines/filter/filter.cpp.
  for (uint row = 0; row <= 2 * push.range && !supported; ++row) {
    for (uint column = 0; column <= 2 * push.range; ++column) {
      const int64_t before = last[corner + row * side + column];
      supported = supported || (before != kNever && t - before <= int64_t(push.period));
    }
  }
  return supported;
}

void main() {
  const uint tile = linear_index();
  if (tile >= push.tiles) return;
  const uint side = push.tile + 2 * push.range;
  // Pixel (0, 0) of the tile's entries on the sensor; below zero it wraps, and so do the differences.
  const uint left = tile % push.tiles_x * push.tile - push.range;
  const uint top = tile / push.tiles_x * push.tile - push.range;
  const uint list = begins[tile * push.chunks];
  const uint end = min(begins[(tile + 1) * push.chunks] - list, push.end);
  // Trips: at most push.end - push.begin, which the host chooses by the device's limit.
  for (uint i = push.begin; i < end; ++i) {
    const uint e = lists[list + i];
    const uvec4 event = event_at(push.first_event + e);
    const uint x = (event.z & 0xFFFF) - left;
    const uint y = (event.z >> 16) - top;
    const int64_t t = time_of(event);
    const uint plane = (tile * 2 + (event.w & 1)) * side * side;
    // Its own tile decides.
    if (x - push.range < push.tile && y - push.range < push.tile) {
      decide(e, event, has_support(plane + (y - push.range) * side + x - push.range, side, t));
    }
    last[plane + y * side + x] = t;
  }
  add_to_report();
}
