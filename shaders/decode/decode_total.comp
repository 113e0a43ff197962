// Decoding, stage "total": where the events of each block go, and the facts of all. One workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
layout(push_constant) uniform Push { DecodePush pushed; };
DecodePush push = pushed;
#include "decode/decode_facts.glsl"
#define JOINED DecodeFacts
#define NOTHING no_events()
#define JOIN join_facts
#include "decode/decode_prefix.glsl"

layout(std430, binding = 0) readonly buffer BlockFacts { DecodeFacts block_facts[]; };
layout(std430, binding = 1) writeonly buffer BlockPlaces { uint block_places[]; };
layout(std430, binding = 2) writeonly buffer Result { DecodeResult result; };
layout(std430, binding = 3) readonly buffer Carry { DecodeCarry carry; };

void main() {
  DecodeFacts run = no_events();
  // Trips: at most 32, for 2^24 words; the same below.
  for (uint b = blocks_begin(); b < blocks_end(); ++b) run = join_facts(run, block_facts[b]);
  DecodeFacts all;
  uint place = joined_before(run, all).inside;
  for (uint b = blocks_begin(); b < blocks_end(); ++b) {
    block_places[b] = place;
    place += block_facts[b].inside;
  }
  if (gl_LocalInvocationID.x == 0) result = DecodeResult(all, carry.state.loops_low, carry.state.loops_high);
}
