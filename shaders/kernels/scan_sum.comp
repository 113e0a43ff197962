// Prefix sum, stage "sum": the sum of each block of words.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "kernels/scan_layout.h"
layout(local_size_x = kPrefixGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) writeonly buffer Sums { uint sums[]; };  // per block
layout(std430, binding = 2) readonly buffer Limit { uint limit; };   // words behind it are left alone
layout(push_constant) uniform Push { PrefixPush pushed; };
PrefixPush push = pushed;

shared uint lane_sums[kPrefixGroup];

void main() {
  const uint block = linear_workgroup();
  const uint count = min(push.words, limit);
  const uint block_begin = block * kPrefixBlock;
  if (block_begin >= push.words) return;  // a whole workgroup
  // Also behind the limit: the sums of these blocks are summed in turn.
  const uint lane = gl_LocalInvocationID.x;
  uint sum = 0;
  if (block_begin < count) {
    // Neighbouring lanes read neighbouring words: which lane takes which word does not matter here.
    // Trips: kPrefixRun.
    for (uint i = 0; i < kPrefixRun; ++i) {
      const uint word = block_begin + i * kPrefixGroup + lane;
      if (word < count) sum += words[word];
    }
  }
  lane_sums[lane] = sum;
  barrier();
  if (lane < kPrefixRow) {
    // Trips: kPrefixGroup / kPrefixRow.
    uint row_sum = 0;
    for (uint i = lane; i < kPrefixGroup; i += kPrefixRow) row_sum += lane_sums[i];
    lane_sums[lane] = row_sum;  // no other lane reads this entry before the barrier
  }
  barrier();
  if (lane == 0) {
    uint block_sum = 0;
    // Trips: kPrefixRow.
    for (uint i = 0; i < kPrefixRow; ++i) block_sum += lane_sums[i];
    sums[block] = block_sum;
  }
}
