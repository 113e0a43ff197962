// Decoding, stage "count": the facts of each block's events, and how many events on the sensor each run of words has
// before it in its block.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
#include "decode/decode_walk.glsl"
#include "decode/decode_facts.glsl"
#define JOINED DecodeFacts
#define NOTHING no_events()
#define JOIN join_facts
#include "decode/decode_prefix.glsl"

layout(std430, binding = 5) writeonly buffer LanePlaces { uint lane_places[]; };
layout(std430, binding = 6) writeonly buffer BlockFacts { DecodeFacts block_facts[]; };

DecodeFacts facts_of(Burst burst, int64_t t) {
  DecodeFacts facts = no_events();
  if (burst.mask == 0) return facts;
  facts.inside = bitCount(burst.inside);
  facts.outside = bitCount(burst.mask) - facts.inside;
  facts.first = facts.last = t;
  if (burst.inside != 0) facts.first_inside = facts.last_inside = facts.smallest = facts.largest = t;
  return facts;
}

void main() {
  if (linear_workgroup() >= push.blocks) return;  // a whole workgroup
  DecodeState state = state_before_run();
  uint skip = skip_before_run();
  uint unknown = 0;
  DecodeFacts facts = no_events();
  // Trips: at most kDecodeRun.
  for (uint i = run_begin(); i < run_end(); ++i) {
    if (skip > 0) {
      --skip;
      continue;
    }
    const uint word = word_at(i);
    if (kFormat == kDecodeEvt2 && type_of(word) == 0xD) skip = kDecodeImuSkip;
    const Burst burst = next_word(state, word, unknown);
    if (burst.mask != 0) facts = join_facts(facts, facts_of(burst, time_of(state)));
  }
  facts.unknown = unknown;
  facts.gaps = gaps;
  DecodeFacts all;
  lane_places[linear_index()] = joined_before(facts, all).inside;
  if (gl_LocalInvocationID.x == 0) block_facts[linear_workgroup()] = all;
}
