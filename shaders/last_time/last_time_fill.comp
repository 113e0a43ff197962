// Stage "reset" of time_window and sae: no pixel has fired.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) writeonly buffer LastTime { uvec2 last_time[]; };
layout(push_constant) uniform Push { FillTimesPush pushed; };
FillTimesPush push = pushed;

void main() {
  const uint place = linear_index();
  if (place < push.times) last_time[place] = uvec2(push.low, push.high);
}
