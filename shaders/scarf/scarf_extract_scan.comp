// SCARF, stage "extract_scan": per-patch counts become the places of their first events, in patch order.
// One workgroup. CPU twin: cpu_ref/stages/scarf/scarf_extract.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/layout.h"
layout(local_size_x = kScanGroup) in;

layout(std430, binding = 0) buffer Cursors { uint cursors[]; };         // counts before, exclusive sums after
layout(std430, binding = 1) writeonly buffer Total { uint all_events; };
layout(push_constant) uniform Push { PatchPush pushed; };
PatchPush push = pushed;

shared uint sums[kScanGroup];

void main() {
  // Each invocation takes a contiguous run of patches. Trips: 2 * (run + 1) + kScanGroup + 2; kMaxPatches in
  // src/pipelines/scarf/plan.h keeps the run below 16,384.
  const uint lane = gl_LocalInvocationID.x;
  const uint run = (push.patches + kScanGroup - 1) / kScanGroup;
  const uint begin = min(lane * run, push.patches);
  const uint end = min(begin + run, push.patches);
  uint sum = 0;
  for (uint i = begin; i < end; ++i) sum += cursors[i];
  sums[lane] = sum;
  barrier();
  uint place = 0;
  for (uint i = 0; i < lane; ++i) place += sums[i];
  if (lane == kScanGroup - 1) all_events = place + sum;
  for (uint i = begin; i < end; ++i) {
    const uint count = cursors[i];
    cursors[i] = place;
    place += count;
  }
}
