// Stage "last_time" of time_window and sae: the last event of each pixel (and polarity) stores its time. One
// invocation per event; a pixel's last event is one of them, so no two write the same pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(1, LastEventView, last_event)
layout(std430, binding = 2) writeonly buffer LastTime { int64_t last_time[]; };  // relative to the first event
layout(push_constant) uniform Push { SurfacePush pushed; };
SurfacePush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uvec4 event = event_at(push.first_event + e);
  const uint pixel = pixel_of(event.z, push.width, push.height);
  if (pixel == kOutside) return;
  const uint plane = push.planes == 2 ? event.w & 1 : 0;
  const uint place = plane * push.width * push.height + pixel;
  if (VIEW_WORD(last_event, place) != push.stamp + e) return;
  last_time[place] = packInt2x32(ivec2(event.xy)) - packInt2x32(ivec2(push.t_first_low, push.t_first_high));
}
