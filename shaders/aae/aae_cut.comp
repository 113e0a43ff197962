// AAE, stage "cut": from which place in the sorted log on each block keeps its events.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_walk.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 2) writeonly buffer KeepFrom { uint keep_from[]; };

void main() {
  const uint block = linear_index();
  if (block >= push.blocks) return;
  const Walk walk = walks[block];
  const uint end = walk.first + walk.count;
  keep_from[block] = push.cut == kCutToLongest ? walk.first : push.cut == kCutAll ? end : end - walk.passed;
}
