// AED-SAE, stage "check": the first event of the submission that is older than the front of the list. The front is the
// first event that is not too old, and that is the first whose prefix maximum is not too old. One invocation per run;
// the smallest place is the same in whichever order atomics compare.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) readonly buffer Prefix { int64_t prefix[]; };

// The time of the front of the list before event i of `run`, when the largest time is t_max.
int64_t front_time(uint run, uint i, int64_t t_max) {
  uint low = state.start / kAedRun;
  uint high = run;
  // Trips: at most 28: runs are halved.
  while (low < high) {
    const uint middle = low + (high - low) / 2;
    if (is_too_old(prefix[middle], t_max, push.window)) low = middle + 1;
    else high = middle;
  }
  uint j = max(low * kAedRun, state.start);
  // Trips: at most kAedRun: the event with the largest time is not too old.
  while (j + 1 < i && is_too_old(time_of(j), t_max, push.window)) ++j;
  return time_of(j);
}

void main() {
  const uint index = linear_index();
  if (index >= push.runs) return;
  const uint run = first_run() + index;
  const uint end = min((run + 1) * kAedRun, log_length);
  const uint begin = max(run * kAedRun, state.start);
  int64_t t_max = run > state.start / kAedRun ? prefix[run - 1] : kNeverFired;
  // Trips: at most kAedRun, and those of front_time for each: 2,000.
  for (uint i = begin; i < end; ++i) {
    const int64_t t = time_of(i);
    if (i >= old_length() && i > state.start && t < t_max) {
      if (t < front_time(run, i, t_max)) {
        atomicMin(state.first_violation, i);
        return;
      }
    }
    t_max = max(t_max, t);
  }
}
