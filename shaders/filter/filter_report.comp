// Noise filters, stage "report": what became of a submission's events joins the report of the stream. One invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter/filter_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/events.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 1) buffer Report { uint report[]; };

void add(uint total, uint number) {
  uint carry;
  report[total] = uaddCarry(report[total], number, carry);
  report[total + 1] += carry;
}

void main() {
  if (linear_index() != 0) return;
  add(kFilterTotalPassed, report[kFilterPassed]);
  add(kFilterTotalRejected, report[kFilterRejected]);
  const uint newest = report[kFilterNewest];
  if (newest != 0) {
    const uvec2 t = event_at(newest - 1).xy;
    report[kFilterNewestTime] = t.x;
    report[kFilterNewestTime + 1] = t.y;
  }
  report[kFilterPassed] = 0;
  report[kFilterRejected] = 0;
  report[kFilterNewest] = 0;
}
