// AAE as in ESVO2, stage "backward": each block draws its newest events, until its activity is near to that after the
// forward pass. One invocation per block, which is the only one to draw the block's pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_walk.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 2) buffer Draws { uint draws[]; };

const uint kCheck = 10;  // events from one check to the next

void main() {
  const uint block = linear_index();
  if (block >= push.blocks) return;
  Walk walk = walks[block];
  if (walk.count == 0) return;
  const uint steps = min(walk.left, kWalkSteps);
  // Trips: kWalkSteps.
  for (uint step = 0; step < steps; ++step) {
    const uint v = walk.first + walk.left - 1;
    if (walk.left < walk.count) {
      walk.activity = next_activity(walk.activity, abs(seconds(time_of(v) - time_of(v + 1))));
    }
    draws[pixel_of(v)] += 1;
    walk.left -= 1;
    const uint drawn = walk.count - walk.left;
    if (drawn % kCheck != 0 || drawn == kCheck) continue;
    precise double distance = abs(walk.activity - walk.converged);
    if (distance < 0.95lf) {
      walk.left = 0;
      break;
    }
  }
  walks[block] = walk;
}
