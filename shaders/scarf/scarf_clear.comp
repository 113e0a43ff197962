// SCARF, stage "clear": every slot becomes empty.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/packed_event.glsl"

layout(std430, binding = 0) writeonly buffer Slots { uint64_t slots[]; };
layout(push_constant) uniform Push { ClearPush pushed; };
ClearPush push = pushed;

void main() {
  const uint slot = linear_index();
  if (slot < push.slots) slots[slot] = kEmptySlot;
}
