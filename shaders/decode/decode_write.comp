// Decoding, stage "write": each run of words writes its events on the sensor, as many of them as the buffer holds at a
// time.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "decode/decode_layout.h"
layout(local_size_x = kDecodeGroup) in;
#include "decode/decode_walk.glsl"

layout(std430, binding = 5) readonly buffer LanePlaces { uint lane_places[]; };
layout(std430, binding = 6) readonly buffer BlockPlaces { uint block_places[]; };
layout(std430, binding = 7) writeonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p

void main() {
  if (linear_workgroup() >= push.blocks) return;
  // Of events before the first one that is written it is a large number.
  uint place = block_places[linear_workgroup()] + lane_places[linear_index()] - push.first_event;
  DecodeState state = state_before_run();
  uint skip = skip_before_run();
  uint unknown = 0;
  // Trips: at most kDecodeRun, and in each a loop of at most 12.
  for (uint i = run_begin(); i < run_end(); ++i) {
    if (skip > 0) {
      --skip;
      continue;
    }
    const uint word = word_at(i);
    if (kFormat == kDecodeEvt2 && type_of(word) == 0xD) skip = kDecodeImuSkip;
    const Burst burst = next_word(state, word, unknown);
    if (burst.inside == 0) continue;
    const uvec2 t = unpackUint2x32(uint64_t(time_of(state)));
    // Trips: as many as bits, at most 12.
    for (uint bits = burst.inside; bits != 0; bits &= bits - 1) {
      if (place < push.events) events[place] = uvec4(t, (burst.x + findLSB(bits)) | state.y << 16, burst.p);
      ++place;
    }
  }
}
