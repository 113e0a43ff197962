// Walks a run of camera words from the state in front of it: what "count" and "write" share.
#include "decode/decode.glsl"
#include "decode/decode_skip.glsl"
#include "decode/decode_summary.glsl"

layout(std430, binding = 1) readonly buffer LaneSkips { uint lane_skips[]; };
layout(std430, binding = 2) readonly buffer BlockSkips { uint block_skips[]; };
layout(std430, binding = 3) readonly buffer LaneSummaries { DecodeSummary lane_summaries[]; };
layout(std430, binding = 4) readonly buffer BlockStates { DecodeState block_states[]; };

// Events of one word: one at x + i for each bit i of the mask.
struct Burst {
  uint mask;
  uint inside;  // those bits whose events are on the sensor
  uint x;
  uint p;
};

DecodeState state_before_run() {
  return state_behind(block_states[linear_workgroup()], lane_summaries[linear_index()]);
}
uint skip_before_run() {
  return kFormat == kDecodeEvt2 ? skip_behind(lane_skips[linear_index()], block_skips[linear_workgroup()]) : 0;
}

int64_t time_of(DecodeState s) {
  const uint high_bits = kFormat == kDecodeEvt2 ? 28 : 12;
  const uint low_bits = kFormat == kDecodeEvt2 ? 6 : 12;
  const uint64_t high = (loops_of(s) << high_bits) + s.time_high;
  return int64_t((high << low_bits | s.time_low) & 0x7FFFFFFFFFFFFFFFul);
}

uint gaps = 0;  // met so far

void set_time_high(inout DecodeState s, uint high) {
  if (high == s.time_high) return;
  const uint next = s.time_high + 1 & 0xFFF;
  if (kFormat == kDecodeEvt3 && high != next) ++gaps;
  add_loops(s, is_wrap(s.time_high, high));
  s.time_high = high;
  s.time_low = 0;
}

Burst burst_of(DecodeState s, uint mask, uint x, uint p) {
  const uint columns = min(push.width - min(x, push.width), 12);
  return Burst(mask, s.y < push.height ? mask & ((1u << columns) - 1) : 0, x, p);
}

Burst next_vector(inout DecodeState s, uint mask, uint length) {
  const uint x = s.base_x;
  s.base_x = min(x + length, kDecodeLastBase);
  return burst_of(s, mask * (1 - s.other), x, s.base_p);
}

// Bit n: type n is defined, that is 0, 1, 8, A and D to F.
const uint kKnownEvt2 = 0xE503u;

// The state behind a word that is not skipped, and its events. `unknown` counts words that mean nothing.
Burst next_word(inout DecodeState s, uint word, inout uint unknown) {
  const uint type = type_of(word);
  if (kFormat == kDecodeEvt2) {
    if (type <= 1) {
      s.time_low = word >> 22 & 63;
      s.y = word & 0x7FF;
      return burst_of(s, 1, word >> 11 & 0x7FF, type);
    }
    if (type == 0x8) set_time_high(s, word & 0x0FFFFFFF);
    unknown += 1 - bit_of(kKnownEvt2, type);
    return Burst(0, 0, 0, 0);
  }
  const uint payload = word & 0xFFF;
  switch (type) {
    case 0x0:
      s.y = payload & 0x7FF;
      s.other = 0;
      break;
    case 0x1:
      s.other = 1;
      break;
    case 0x2:
      return burst_of(s, 1 - s.other, payload & 0x7FF, payload >> 11);
    case 0x3:
      s.base_x = payload & 0x7FF;
      s.base_p = payload >> 11;
      break;
    case 0x4:
      return next_vector(s, payload, 12);
    case 0x5:
      return next_vector(s, payload & 0xFF, 8);
    case 0x6:
      s.time_low = payload;
      break;
    case 0x8:
      set_time_high(s, payload);
      break;
    case 0x9:
      if (word != 0x9999) ++unknown;
      break;
    case 0xB:
    case 0xC:
      ++unknown;
      break;
  }
  return Burst(0, 0, 0, 0);
}
