// AED-SAE, stage "clears": the last clear of the submission, and the largest time since. Where the check stage has found
// none, there is nothing to do. Else one invocation walks the events from there on, as defined; that is rare.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 4) readonly buffer Prefix { int64_t prefix[]; };

void clear_at(uint i) {
  state.start = i;
  state.front = i;
  state.next = i + 1;
  state.t_max = time_of(i);
}

void main() {
  if (linear_index() != 0) return;
  if (push.begin != 0) {
    if (state.first_violation != kNoViolation) {
      state.cleared = 1;
      clear_at(state.first_violation);
    } else if (log_length > 0) {
      state.t_max = prefix[(log_length - 1) / kAedRun];
    }
  }
  if (state.cleared == 0) return;
  // Trips: steps. Each moves `next` or `front` on, so that twice the events of the submission are enough.
  for (uint step = 0; step < push.steps && state.next < log_length; ++step) {
    const int64_t t_front = time_of(state.front);
    if (is_too_old(t_front, state.t_max, push.window)) {
      state.front += 1;
      continue;
    }
    const uint i = state.next;
    const int64_t t = time_of(i);
    if (t < t_front) {
      clear_at(i);
    } else {
      state.t_max = max(state.t_max, t);
      state.next = i + 1;
    }
  }
}
