// SCARF, stage "extract_count": how many events of each patch will be handed out.
// CPU twin: cpu_ref/stages/scarf/scarf_extract.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/packed_event.glsl"
#include "common/ring_head.glsl"
#include "scarf/scarf_patch.glsl"

layout(std430, binding = 0) readonly buffer Slots { uvec2 slots[]; };
layout(std430, binding = 1) readonly buffer Heads { uint heads[]; };  // see ring_head.glsl
layout(std430, binding = 2) readonly buffer Laps { uint64_t laps[]; };
layout(std430, binding = 3) buffer Cursors { uint cursors[]; };

void main() {
  const uint index = linear_index();
  if (index >= push.patches) return;
  const uint patch_id = push.first_patch + index;
  const uint ring = patch_of(patch_id).ring;
  const uint end = min(push.slot_end, filled_slots(heads[patch_id], laps[patch_id], push.capacity));
  uint count = push.slot_begin == 0 ? 0 : cursors[index];
  // Trips: at most kSlotsPerDispatch. The order of slots does not matter to a count.
  for (uint s = push.slot_begin; s < end; ++s) {
    if (push.mode == 0 || is_active(slots[ring + s].x)) ++count;
  }
  cursors[index] = count;
}
