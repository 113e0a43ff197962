// AAE, stage "walk": each block draws its newest events, backwards, until its activity is near to where it converges.
// One invocation per block, which is the only one to draw the block's pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_walk.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 2) buffer Draws { uint draws[]; };

void main() {
  const uint block = linear_index();
  if (block >= push.blocks) return;
  Walk walk = walks[block];
  if (walk.left == 0) return;
  const uint steps = min(walk.left, kWalkSteps);
  int64_t t = time_of(walk.first + walk.left);
  // Trips: kWalkSteps.
  for (uint step = 0; step < steps; ++step) {
    const uint v = walk.first + walk.left;
    const int64_t earlier = time_of(v - 1);
    walk.activity = next_activity(walk.activity, seconds(t - earlier));
    draws[pixel_of(v)] += 1;
    if (walk.converged > 0.0lf) {
      precise double distance = abs(walk.activity - walk.converged) / walk.converged;
      if (distance < 0.02lf) {
        walk.left = 0;
        break;
      }
    }
    walk.passed += 1;
    walk.left -= 1;
    t = earlier;
  }
  walks[block] = walk;
}
