// SCARF, stage "count": hits of each chunk of events on each patch. One invocation per event: a count does not depend
// on order, so atomics are exact.
// CPU twin: cpu_ref/stages/scarf_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "batch.glsl"
#include "invocation.glsl"

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint base = e / push.chunk_events * push.patches;
  const Field field = field_of(events[push.first_event + e].z);
  // Trips: at most 128 rows of at most 128 patches and an entry each.
  for (uint j = field.rows & 0xFFFF; j <= field.rows >> 16; ++j) {
    for (uint i = field.columns & 0xFFFF; i <= field.columns >> 16; ++i) {
      atomicAdd(table[base + j * push.grid_x + i], 1);
    }
  }
}
