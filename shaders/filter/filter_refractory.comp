// Noise filter "refractory": an event is rejected if its pixel let one pass shortly before.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter/filter_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "filter/filter.glsl"

void main() {
  const uint tile = linear_index();
  if (tile >= push.tiles) return;
  const uint list = begins[tile * push.chunks];
  const uint end = min(begins[(tile + 1) * push.chunks] - list, push.end);
  // Trips: at most push.end - push.begin, which the host chooses by the device's limit.
  for (uint i = push.begin; i < end; ++i) {
    const uint e = lists[list + i];
    const uvec4 event = event_at(push.first_event + e);
    const uint pixel = (event.z >> 16) * push.width + (event.z & 0xFFFF);
    const int64_t t = time_of(event);
    const int64_t before = last[pixel];
    const bool blind = before != kNever && before <= t && t - before < int64_t(push.period);
    decide(e, event, !blind);
    if (!blind) last[pixel] = t;
  }
  add_to_report();
}
