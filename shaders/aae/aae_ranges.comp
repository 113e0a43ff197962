// AAE, stage "ranges": where the events of each block begin and end in the sorted log. Blocks without events keep zeros.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Sorted { uvec4 sorted[]; };
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) writeonly buffer Ranges { uint ranges[]; };  // per block: begin, end
layout(push_constant) uniform Push { AaePush pushed; };
AaePush push = pushed;
#include "aae/aae_block.glsl"

void main() {
  const uint i = linear_index();
  const uint count = min(push.events, log_length);
  if (i >= count) return;
  const uint block = block_of(sorted[i].z);
  if (i == 0 || block_of(sorted[max(i, 1) - 1].z) != block) ranges[2 * block] = i;
  if (i + 1 == count || block_of(sorted[min(i + 1, count - 1)].z) != block) ranges[2 * block + 1] = i + 1;
}
