// Decoding, stage "scan": the state of the decoder in front of each block, and the one that is carried on. One
// workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
layout(constant_id = 0) const uint kFormat = kDecodeEvt2;
layout(push_constant) uniform Push { DecodePush pushed; };
DecodePush push = pushed;
#include "decode/decode_summary.glsl"
#define JOINED DecodeSummary
#define NOTHING no_words()
#define JOIN join_summaries
#include "decode/decode_prefix.glsl"

layout(std430, binding = 0) readonly buffer BlockSummaries { DecodeSummary block_summaries[]; };
layout(std430, binding = 1) writeonly buffer BlockStates { DecodeState block_states[]; };
layout(std430, binding = 2) buffer Carry { DecodeCarry carry; };

void main() {
  const DecodeState carried = carry.state;
  DecodeSummary run = no_words();
  // Trips: at most 32, for 2^24 words; the same below.
  for (uint b = blocks_begin(); b < blocks_end(); ++b) run = join_summaries(run, block_summaries[b]);
  DecodeSummary all;
  DecodeState state = state_behind(carried, joined_before(run, all));
  for (uint b = blocks_begin(); b < blocks_end(); ++b) {
    block_states[b] = state;
    state = state_behind(state, block_summaries[b]);
  }
  // Every lane has read the carried state before the barriers above.
  if (gl_LocalInvocationID.x == 0) carry.state = state_behind(carried, all);
}
