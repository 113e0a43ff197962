// Stage "last_event": the stamp of each pixel's (and polarity's) last event. Stamps number the events of the stream from
// 1 on, so entries of earlier submissions need not be cleared. The largest is the same in whichever order atomics compare.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) buffer LastEvent { uint last_event[]; };
layout(push_constant) uniform Push { SurfacePush pushed; };
SurfacePush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uvec4 event = event_at(push.first_event + e);
  const uint pixel = pixel_of(event.z, push.width, push.height);
  if (pixel == kOutside) return;
  const uint plane = push.planes == 2 ? event.w & 1 : 0;
  atomicMax(last_event[plane * push.width * push.height + pixel], push.stamp + e);
}
