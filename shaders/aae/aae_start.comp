// AAE, stage "start": the queue of each block, and the activity that its walk is compared with.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_walk.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 2) readonly buffer Ranges { uint ranges[]; };

void main() {
  const uint block = linear_index();
  if (block >= push.blocks) return;
  const uint end = ranges[2 * block + 1];
  Walk walk;
  walk.count = min(end - ranges[2 * block], kLongestQueue);
  walk.first = end - walk.count;
  walk.activity = 0.0lf;
  walk.converged = 0.0lf;
  walk.left = max(walk.count, 1) - 1;
  walk.passed = 0;
  if (walk.count >= 2) {
    precise double mean = seconds(time_of(end - 1) - time_of(walk.first)) / double(walk.count - 1);
    if (mean > 0.0lf) {
      precise double converged = 1.0lf / sqrt(mean);
      walk.converged = converged;
    }
  }
  walks[block] = walk;
}
