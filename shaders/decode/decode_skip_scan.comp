// Decoding, stage "skip scan", EVT2 only: the maps of blocks become the number of words to be skipped in front of each,
// in place. One workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
layout(push_constant) uniform Push { DecodePush pushed; };
DecodePush push = pushed;
#include "decode/decode_skip.glsl"
#define JOINED uint
#define NOTHING kDecodeSkipSame
#define JOIN join_skips
#include "decode/decode_prefix.glsl"

layout(std430, binding = 0) buffer BlockSkips { uint block_skips[]; };
layout(std430, binding = 1) buffer Carry { DecodeCarry carry; };

void main() {
  const uint carried = carry.skip;
  uint map = kDecodeSkipSame;
  // Trips: at most 32, for 2^24 words; the same below.
  for (uint b = blocks_begin(); b < blocks_end(); ++b) map = join_skips(map, block_skips[b]);
  uint all;
  uint skip = skip_behind(joined_before(map, all), carried);
  for (uint b = blocks_begin(); b < blocks_end(); ++b) {
    const uint block = block_skips[b];
    block_skips[b] = skip;
    skip = skip_behind(block, skip);
  }
  // Every lane has read the carried number before the barriers above.
  if (gl_LocalInvocationID.x == 0) carry.skip = skip_behind(all, carried);
}
