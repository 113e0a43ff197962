// SCARF, stage "prune": where the events of a chunk have no surviving hit at all, so that they need not be walked.
// Events whose fields begin at the same patch are judged together, by all patches that any of them can hit.
// CPU twin: cpu_ref/stages/scarf/scarf_prune.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(0, TableView, table)  // cursors
layout(std430, binding = 1) writeonly buffer Alive { uint alive[]; };       // per chunk and first patch: 0 or 1
layout(push_constant) uniform Push { PrunePush pushed; };
PrunePush push = pushed;

void main() {
  const uint entry = linear_index();
  if (entry >= push.chunks * push.patches) return;
  const uint patch_id = entry % push.patches;
  const uint chunk_base = entry - patch_id;
  const uint i = patch_id % push.grid_x;
  const uint j = patch_id / push.grid_x;
  const uint i_end = min(i + push.most_columns, push.grid_x);
  const uint j_end = min(j + push.most_rows, push.patches / push.grid_x);
  uint any_alive = 0;
  // Trips: at most 128 rows of at most 128 patches and an entry each.
  for (uint b = j; b < j_end; ++b) {
    for (uint a = i; a < i_end; ++a) {
      any_alive |= VIEW_WORD(table, chunk_base + b * push.grid_x + a) != kCursorDead ? 1 : 0;
    }
  }
  alive[entry] = any_alive;
}
