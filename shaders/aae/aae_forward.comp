// AAE as in ESVO2, stage "forward": the activity of each block after all events of its queue. In the first dispatch all
// but one step are left, and the activity is 0; its first event makes it 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_walk.glsl"
#include "common/invocation.glsl"

void main() {
  const uint block = linear_index();
  if (block >= push.blocks) return;
  Walk walk = walks[block];
  if (walk.count == 0) return;
  if (walk.activity == 0.0lf) {
    walk.activity = 1.0lf;
    walk.converged = 1.0lf;
  }
  if (walk.passed != 0) return;  // the backward pass has been prepared
  const uint end = walk.first + walk.count;
  const uint steps = min(walk.left, kWalkSteps);
  // Trips: kWalkSteps.
  for (uint step = 0; step < steps; ++step) {
    const uint v = end - walk.left;
    walk.converged = next_activity(walk.converged, abs(seconds(time_of(v) - time_of(v - 1))));
    walk.left -= 1;
  }
  if (walk.left == 0) {
    walk.passed = 1;
    walk.left = walk.count;
  }
  walks[block] = walk;
}
