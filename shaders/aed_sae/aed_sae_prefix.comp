// AED-SAE, stage "prefix": the largest time from the last clear to the end of each run. One invocation per group of runs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) readonly buffer RunLargest { int64_t run_largest[]; };
layout(std430, binding = 5) readonly buffer GroupLargest { int64_t group_largest[]; };
layout(std430, binding = 6) buffer Prefix { int64_t prefix[]; };

void main() {
  const uint group = linear_index();
  if (group * push.group_runs >= push.runs || range_is_empty()) return;
  const uint first = first_run();
  const uint end = min(min((group + 1) * push.group_runs, push.runs) + first, (log_length + kAedRun - 1) / kAedRun);
  // No invocation writes the entry of the run before the first.
  int64_t largest = first > state.start / kAedRun ? prefix[first - 1] : kNeverFired;
  // Trips: groups, at most 8,192 in a submission and the square root of the runs else.
  for (uint before = 0; before < group; ++before) largest = max(largest, group_largest[before]);
  // Trips: at most group_runs.
  for (uint run = first + group * push.group_runs; run < end; ++run) {
    largest = max(largest, run_largest[run]);
    prefix[run] = largest;
  }
}
