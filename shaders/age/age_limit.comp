// Stage "limit" of eros and tos: ages as they are shown, 0 .. 65,534 and 65,535 for pixels that never fired; or, in
// place, before they can run over.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surface_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Ages { uint ages[]; };
layout(std430, binding = 1) writeonly buffer Limited { uint limited[]; };
layout(push_constant) uniform Push { AgeLimitPush pushed; };
AgeLimitPush push = pushed;

void main() {
  const uint pixel = linear_index();
  if (pixel < push.pixels) limited[pixel] = ages[pixel] >= kAgeNever ? push.never : min(ages[pixel], 65534);
}
