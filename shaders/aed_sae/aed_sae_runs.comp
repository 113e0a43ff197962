// AED-SAE, stage "runs": the largest time of each run of the log.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) writeonly buffer RunLargest { int64_t run_largest[]; };

void main() {
  const uint index = linear_index();
  if (index >= push.runs || range_is_empty()) return;
  const uint run = first_run() + index;
  const uint end = min((run + 1) * kAedRun, log_length);
  int64_t largest = kNeverFired;
  // Trips: at most kAedRun. Events before the last clear do not count.
  for (uint i = max(run * kAedRun, state.start); i < end; ++i) largest = max(largest, time_of(i));
  if (run * kAedRun < log_length) run_largest[run] = largest;
}
