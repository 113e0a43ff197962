// SCARF, stage "render": the active stored events of each patch, together or told apart by polarity, are counted into
// the pixels of its cell.
// CPU twin: cpu_ref/stages/scarf/scarf_render.cpp
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
layout(std430, binding = 3) buffer Counts { int counts[]; };  // planes; zeros before the first dispatch

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  const Patch p = patch_of(patch_id);
  const uint plane = push.width * push.height;
  const uint end = min(push.slot_end, filled_slots(heads[patch_id], laps[patch_id], push.capacity));
  const uint plane_of_on = push.mode == kModeSeparate ? plane : 0;
  const int less_for_off = push.mode == kModeDifference ? 2 : 0;
  // No other invocation counts in this patch's cell. Trips: at most kSlotsPerDispatch.
  for (uint s = push.slot_begin; s < end; ++s) {
    const uint word = slots[p.ring + s].x;
    if (!is_active(word)) continue;
    const uint x = uint(p.field_x) + packed_x(word);
    const uint y = uint(p.field_y) + packed_y(word);
    const uint on = packed_polarity(word);
    counts[y * push.width + x + on * plane_of_on] += 1 - int(1 - on) * less_for_off;
  }
}
