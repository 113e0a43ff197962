// Prefix sum, stage "block": within each block, every word becomes the sum of the words before it, in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernels/scan_layout.h"
layout(local_size_x = kPrefixGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Offsets { uint offsets[]; };  // per block; valid if push.has_offsets
layout(std430, binding = 2) readonly buffer Limit { uint limit; };        // words behind it are left alone
layout(push_constant) uniform Push { PrefixPush pushed; };
PrefixPush push = pushed;

shared uint lane_sums[kPrefixGroup];
shared uint row_sums[kPrefixGroup / kPrefixRow];

void main() {
  const uint block = linear_workgroup();
  const uint count = min(push.words, limit);
  const uint block_begin = block * kPrefixBlock;
  if (block_begin >= count) return;  // a whole workgroup
  const uint lane = gl_LocalInvocationID.x;
  const uint begin = block_begin + lane * kPrefixRun;
  uint run[kPrefixRun];
  uint sum = 0;
  // Trips: kPrefixRun.
  for (uint i = 0; i < kPrefixRun; ++i) {
    run[i] = begin + i < count ? words[begin + i] : 0;
    sum += run[i];
  }
  lane_sums[lane] = sum;
  barrier();
  if (lane % kPrefixRow == 0) {
    uint row_sum = 0;
    // Trips: kPrefixRow.
    for (uint i = 0; i < kPrefixRow; ++i) row_sum += lane_sums[lane + i];
    row_sums[lane / kPrefixRow] = row_sum;
  }
  barrier();
  uint before = push.has_offsets != 0 ? offsets[block] : 0;
  // Trips: at most kPrefixGroup / kPrefixRow.
  for (uint row = 0; row < lane / kPrefixRow; ++row) before += row_sums[row];
  // Trips: at most kPrefixRow.
  for (uint i = lane - lane % kPrefixRow; i < lane; ++i) before += lane_sums[i];
  // Trips: kPrefixRun.
  for (uint i = 0; i < kPrefixRun; ++i) {
    if (begin + i < count) words[begin + i] = before;
    before += run[i];
  }
}
