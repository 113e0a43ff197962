// SCARF, stage "settle": the laps that the append stage counted in the heads join the laps, so that a head never overflows.
// CPU twin: cpu_ref/stages/scarf/scarf_settle.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/ring_head.glsl"

layout(std430, binding = 0) buffer Heads { uint heads[]; };
layout(std430, binding = 1) buffer Laps { uint64_t laps[]; };
layout(std430, binding = 2) buffer PaintedHeads { uint painted_heads[]; };  // see scarf_paint.comp
layout(push_constant) uniform Push { SettlePush pushed; };
SettlePush push = pushed;

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  const uint head = heads[patch_id];
  laps[patch_id] = all_laps(head, laps[patch_id]);
  heads[patch_id] = head_slot(head);
  painted_heads[patch_id] = kNeverPainted;
}
