// Stage "count" of eros and tos: each event ages the pixels of its window by one, but for those that fire later in the
// submission, and itself. One invocation per event: a count does not depend on order, so atomics are exact.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(1, LastEventView, last_event)
layout(std430, binding = 2) buffer Ages { uint ages[]; };
layout(push_constant) uniform Push { SurfacePush pushed; };
SurfacePush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint xy = event_at(push.first_event + e).z;
  if (pixel_of(xy, push.width, push.height) == kOutside) return;
  const uint x = xy & 0xFFFF;
  const uint y = xy >> 16;
  const uint left = x - min(x, push.reach);
  const uint right = min(x + push.reach, push.width - 1);
  const uint bottom = min(y + push.reach, push.height - 1);
  // Trips: at most 63 rows of at most 63 pixels and an entry each.
  for (uint row = y - min(y, push.reach); row <= bottom; ++row) {
    for (uint column = left; column <= right; ++column) {
      const uint pixel = row * push.width + column;
      if (VIEW_WORD(last_event, pixel) < push.stamp + e) atomicAdd(ages[pixel], 1);
    }
  }
}
