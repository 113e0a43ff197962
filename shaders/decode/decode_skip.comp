// Decoding, stage "skip", EVT2 only: what each run and each block does to the number of words that are still to be
// skipped of an IMU block.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
#include "decode/decode.glsl"
#include "decode/decode_skip.glsl"
#define JOINED uint
#define NOTHING kDecodeSkipSame
#define JOIN join_skips
#include "decode/decode_prefix.glsl"

layout(std430, binding = 1) writeonly buffer LaneSkips { uint lane_skips[]; };    // from the block's beginning
layout(std430, binding = 2) writeonly buffer BlockSkips { uint block_skips[]; };

const uint kImu = 0xD;

void main() {
  if (linear_workgroup() >= push.blocks) return;  // a whole workgroup
  uint map = kDecodeSkipSame;
  // Trips: at most kDecodeRun.
  for (uint i = run_begin(); i < run_end(); ++i) {
    const uint skipping = (map | map >> 1 | map >> 2) & kDecodeSkipOnes;
    map -= skipping;
    if (type_of(word_at(i)) == kImu) map += (~skipping & kDecodeSkipOnes) * kDecodeImuSkip;
  }
  uint all;
  lane_skips[linear_index()] = joined_before(map, all);
  if (gl_LocalInvocationID.x == 0) block_skips[linear_workgroup()] = all;
}
