// SCARF, stage "render": the active stored events of each patch are counted into the pixels of its cell.
// CPU twin: cpu_ref/stages/scarf_render.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"
#include "packed_event.glsl"
#include "scarf_patch.glsl"

layout(std430, binding = 0) readonly buffer Slots { uvec2 slots[]; };
layout(std430, binding = 1) readonly buffer Totals { uvec2 totals[]; };
layout(std430, binding = 2) buffer Rendered { uvec2 rendered[]; };  // totals when the patch was last drawn
layout(std430, binding = 3) buffer Counts { int counts[]; };        // planes

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  const uvec2 total = totals[patch_id];
  const bool first_dispatch = push.slot_begin == 0;
  const bool last_dispatch = push.slot_end == push.capacity;
  if (push.render_all == 0 && total == rendered[patch_id]) return;
  if (last_dispatch) rendered[patch_id] = total;

  const Patch p = patch_of(patch_id);
  const uint plane = push.width * push.height;
  const uint planes = push.mode == kModeSeparate ? 2 : 1;
  if (first_dispatch) {
    const int x0 = p.field_x + int(push.margin_lo_x);
    const int y0 = p.field_y + int(push.margin_lo_y);
    const int x1 = min(x0 + int(push.cell_x), int(push.width));
    const int y1 = min(y0 + int(push.cell_y), int(push.height));
    // Trips: at most 128 rows of at most 128 pixels and an entry each.
    for (int y = max(y0, 0); y < y1; ++y) {
      for (int x = max(x0, 0); x < x1; ++x) {
        counts[y * push.width + x] = 0;
        if (planes == 2) counts[plane + y * push.width + x] = 0;
      }
    }
  }
  const uint end = min(push.slot_end, filled_slots(total));
  // Trips: at most kSlotsPerDispatch.
  for (uint s = push.slot_begin; s < end; ++s) {
    const uint word = slots[p.ring + s].x;
    if (!is_active(word)) continue;
    const uint x = uint(p.field_x) + packed_x(word);
    const uint y = uint(p.field_y) + packed_y(word);
    const uint polarity = packed_polarity(word);
    const uint pixel = y * push.width + x + (push.mode == kModeSeparate ? polarity * plane : 0);
    counts[pixel] += push.mode == kModeDifference && polarity == 0 ? -1 : 1;
  }
}
