// Measures a device: words copied from one buffer to another, four per invocation. No pipeline uses it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };
layout(std430, binding = 1) writeonly buffer To { uvec4 to[]; };
layout(push_constant) uniform Push { CeilingPush pushed; };
CeilingPush push = pushed;

void main() {
  const uint i = linear_index();
  if (i < push.invocations) to[i] = from[i];
}
