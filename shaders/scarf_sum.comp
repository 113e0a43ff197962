// SCARF, stage "sum": running sums along lines of the counts per class, in place; first along all rows, then along all
// columns. Afterwards four entries give the events in any rectangle of classes.
// CPU twin: cpu_ref/stages/scarf_sum.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(binding = 0, r32ui) uniform uimageBuffer counts;
layout(push_constant) uniform Push { SumPush pushed; };
SumPush push = pushed;

void main() {
  const uint line = linear_index();
  if (line >= push.chunks * push.lines) return;
  const uint begin = line / push.lines * push.class_words + line % push.lines * push.line_stride;
  uint sum = 0;
  // Trips: classes of one axis, at most one per pixel and class 0: 16,385.
  for (uint i = 0; i < push.line_classes; ++i) {
    const int entry = int(begin + i * push.class_stride);
    sum += imageLoad(counts, entry).x;
    imageStore(counts, entry, uvec4(sum));
  }
}
