// Stage "start" of eros and tos: the age of each pixel that fires in the submission becomes 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(1, LastEventView, last_event)
layout(std430, binding = 2) writeonly buffer Ages { uint ages[]; };
layout(push_constant) uniform Push { SurfacePush pushed; };
SurfacePush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint pixel = pixel_of(event_at(push.first_event + e).z, push.width, push.height);
  if (pixel != kOutside && VIEW_WORD(last_event, pixel) == push.stamp + e) ages[pixel] = 0;
}
