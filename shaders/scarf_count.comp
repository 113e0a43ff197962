// SCARF, stage "count": hits of each chunk of events on each patch. One invocation per event: a count does not depend
// on order, so atomics are exact.
// CPU twin: cpu_ref/stages/scarf_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "batch.glsl"
#include "invocation.glsl"

// The corners of an event's rectangle of patches, so that sums along rows and columns (scarf_integrate.comp) give the
// hits: at most four atomics, however many patches there are.
void count_corners(uint base, uvec2 first, uvec2 beyond) {
  const bool right = beyond.x < push.grid_x;
  const bool below = beyond.y < push.patches / push.grid_x;
  atomicAdd(table[base + first.y * push.grid_x + first.x], 1);
  if (right) atomicAdd(table[base + first.y * push.grid_x + beyond.x], uint(-1));
  if (below) atomicAdd(table[base + beyond.y * push.grid_x + first.x], uint(-1));
  if (right && below) atomicAdd(table[base + beyond.y * push.grid_x + beyond.x], 1);
}

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const Field field = field_of(events[push.first_event + e].z);
  if (!has_patches(field)) return;
  const uint base = e / push.chunk_events * push.patches;
  const uvec2 first = uvec2(field.columns, field.rows) & 0xFFFF;
  const uvec2 beyond = (uvec2(field.columns, field.rows) >> 16) + 1;
  if (push.count_corners != 0) {
    count_corners(base, first, beyond);
    return;
  }
  // Trips: at most 128 rows of at most 128 patches and an entry each.
  for (uint j = first.y; j < beyond.y; ++j) {
    for (uint i = first.x; i < beyond.x; ++i) atomicAdd(table[base + j * push.grid_x + i], 1);
  }
}
