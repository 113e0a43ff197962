// SCARF, stage "count": events of each chunk in each class of pixels; the pixels of a class lie in the same patches.
// One invocation per event: a count does not depend on order, so atomics are exact.
// CPU twin: cpu_ref/stages/scarf/scarf_count.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/batch.glsl"
#include "common/invocation.glsl"
#include "common/views.glsl"

WORDS_VIEW(1, ClassesView, classes)  // per column, then row; 0: no patch
layout(std430, binding = 2) buffer Counts { uint counts[]; };  // per chunk, row class, column class

uint class_at(uint entry) { return VIEW_WORD(classes, entry); }

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint xy = event_at(push.first_event + e).z;
  const uint cell = class_at(row_entry(xy)) * push.class_columns + class_at(column_entry(xy));
  atomicAdd(counts[e / push.chunk_events * push.class_words + cell], 1);
}
