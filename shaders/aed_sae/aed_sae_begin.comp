// AED-SAE, stage "begin": nothing is known of a submission yet.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "aed_sae/aed_sae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aed_sae/aed_sae_push.glsl"
#include "common/invocation.glsl"

void main() {
  if (linear_index() != 0) return;
  state.first_violation = kNoViolation;
  state.cleared = 0;
}
