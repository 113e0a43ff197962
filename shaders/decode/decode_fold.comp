// Decoding, stage "fold": what each run and each block of words does to the state of the decoder.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
#include "decode/decode.glsl"
#include "decode/decode_skip.glsl"
#include "decode/decode_summary.glsl"
#define JOINED DecodeSummary
#define NOTHING no_words()
#define JOIN join_summaries
#include "decode/decode_prefix.glsl"

layout(std430, binding = 1) readonly buffer LaneSkips { uint lane_skips[]; };
layout(std430, binding = 2) readonly buffer BlockSkips { uint block_skips[]; };
layout(std430, binding = 3) writeonly buffer LaneSummaries { DecodeSummary lane_summaries[]; };  // from the block's beginning
layout(std430, binding = 4) writeonly buffer BlockSummaries { DecodeSummary block_summaries[]; };

// What one word does.
DecodeSummary summary_of(uint word) {
  DecodeSummary s = no_words();
  const uint type = type_of(word);
  if (type == 0x8) s.first = s.last = kFormat == kDecodeEvt2 ? word & 0x0FFFFFFF : word & 0xFFF;
  if (kFormat == kDecodeEvt2) return s;
  const uint payload = word & 0xFFF;
  switch (type) {
    case 0x0:
      s.row = (payload & 0x7FF) | kDecodeRowSet | kDecodeOtherSet;
      break;
    case 0x1:
      s.row = kDecodeOther | kDecodeOtherSet;
      break;
    case 0x3:
      s.base = (payload & 0x7FF) | (payload >> 11) * kDecodeBasePolarity | kDecodeBaseSet;
      break;
    case 0x4:
      s.base = 12;
      break;
    case 0x5:
      s.base = 8;
      break;
    case 0x6:
      s.low = payload | kDecodeLowSet;
      break;
  }
  return s;
}

void main() {
  if (linear_workgroup() >= push.blocks) return;  // a whole workgroup
  uint skip = kFormat == kDecodeEvt2 ? skip_behind(lane_skips[linear_index()], block_skips[linear_workgroup()]) : 0;
  DecodeSummary run = no_words();
  // Trips: at most kDecodeRun.
  for (uint i = run_begin(); i < run_end(); ++i) {
    if (skip > 0) {
      --skip;
      continue;
    }
    const uint word = word_at(i);
    if (kFormat == kDecodeEvt2 && type_of(word) == 0xD) skip = kDecodeImuSkip;
    run = join_summaries(run, summary_of(word));
  }
  DecodeSummary all;
  lane_summaries[linear_index()] = joined_before(run, all);
  if (gl_LocalInvocationID.x == 0) block_summaries[linear_workgroup()] = all;
}
