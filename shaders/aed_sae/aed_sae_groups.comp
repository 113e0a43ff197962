// AED-SAE, stage "groups": the largest time of each group of runs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) readonly buffer RunLargest { int64_t run_largest[]; };
layout(std430, binding = 5) writeonly buffer GroupLargest { int64_t group_largest[]; };

void main() {
  const uint group = linear_index();
  if (group * push.group_runs >= push.runs || range_is_empty()) return;
  const uint end = min(min((group + 1) * push.group_runs, push.runs) + first_run(),
                       (log_length + kAedRun - 1) / kAedRun);
  int64_t largest = kNeverFired;
  // Trips: at most group_runs: 64, or the square root of the number of runs.
  for (uint run = first_run() + group * push.group_runs; run < end; ++run) largest = max(largest, run_largest[run]);
  group_largest[group] = largest;
}
