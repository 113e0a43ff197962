// Running sums along lines of a table, in place; first along all rows, then along all columns. SCARF's stage "sum":
// afterwards four entries give the events in any rectangle of classes. The replay's stage "integrate": the corners that
// replay_count.comp counted become hits.
// CPU twin: cpu_ref/stages/kernels/running_sums.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/views.glsl"

IMAGE_VIEW(0, TableView, table)
layout(push_constant) uniform Push { SumPush pushed; };
SumPush push = pushed;

void main() {
  const uint line = linear_index();
  if (line >= push.chunks * push.lines) return;
  const uint begin = line / push.lines * push.chunk_words + line % push.lines * push.line_stride;
  uint sum = 0;
  // Trips: classes or patches of one axis, at most 49,152.
  for (uint i = 0; i < push.entries; ++i) {
    const int entry = int(begin + i * push.entry_stride);
    sum += IMAGE_WORD(table, entry);
    SET_IMAGE_WORD(table, entry, sum);
  }
}
