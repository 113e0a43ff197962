// SCARF, stage "extract_write": the events of each patch, oldest to newest, at the places that the scan gave.
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
// Events of 16 bytes take twice the room of slots; two halves keep each within one buffer binding.
layout(std430, binding = 4) writeonly buffer FirstHalf { uvec4 first_half[]; };
layout(std430, binding = 5) writeonly buffer SecondHalf { uvec4 second_half[]; };

void main() {
  const uint index = linear_index();
  if (index >= push.patches) return;
  const uint patch_id = push.first_patch + index;
  const Patch p = patch_of(patch_id);
  const uint head = heads[patch_id];
  const uint filled = filled_slots(head, laps[patch_id], push.capacity);
  const uint oldest = filled < push.capacity ? 0 : head_slot(head);
  const uint end = min(push.slot_end, filled);
  const uint half_events = push.half_events;
  const uint64_t t_first = packUint2x32(uvec2(push.t_first_low, push.t_first_high));
  uint place = cursors[index];
  // Trips: at most kSlotsPerDispatch.
  for (uint rank = push.slot_begin; rank < end; ++rank) {
    const uint slot = oldest + rank < push.capacity ? oldest + rank : oldest + rank - push.capacity;
    const uvec2 word = slots[p.ring + slot];
    if (push.mode == 0 || is_active(word.x)) {
      const uvec4 event = unpack_event(word, p.field_x, p.field_y, t_first);
      if (place < half_events) first_half[place] = event;
      else second_half[place - half_events] = event;
      ++place;
    }
  }
  cursors[index] = place;
}
