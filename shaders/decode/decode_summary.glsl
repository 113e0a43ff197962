// Joins what words do to a decoder's state; see DecodeSummary. Both functions follow the rules of docs/FORMATS.md:
// a fall of TIME_HIGH by half its range is a wrap; in EVT3 a new TIME_HIGH sets TIME_LOW to 0, a repeated one does not.
#include "common/bits.glsl"

uint is_wrap(uint before, uint high) {
  const uint half_range = kFormat == kDecodeEvt2 ? 1u << 27 : 1u << 11;
  return high < before && before - high >= half_range ? 1 : 0;
}

// The bits of `field` as they are behind, if those words set them: then they have the mark.
uint later(uint before, uint behind, uint mark, uint field) {
  return blend(all_if(behind, mark) & field, behind, before);
}

DecodeSummary no_words() { return DecodeSummary(kDecodeNone, kDecodeNone, 0, 0, 0, 0); }

// First a, then b.
DecodeSummary join_summaries(DecodeSummary a, DecodeSummary b) {
  const uint kLow = 0x1FFF;  // a TIME_LOW with its mark
  const uint b_low = all_if(b.low, kDecodeLowSet);
  DecodeSummary both = a;
  if (b.first == kDecodeNone) {
    const uint shift = a.first == kDecodeNone ? 0 : kDecodeLowShift;
    both.low = blend(b_low & kLow << shift, (b.low & kLow) << shift, a.low);
  } else if (a.first == kDecodeNone) {
    both.first = b.first;
    both.last = b.last;
    both.wraps = b.wraps;
    both.low = blend(~b_low & kLow, a.low, b.low);
  } else {
    both.last = b.last;
    both.wraps = a.wraps + b.wraps + is_wrap(a.last, b.first);
    // A TIME_LOW behind b's first TIME_HIGH; else, if that one only repeats a's last, the one before it; else 0.
    const uint repeated = blend(b_low, b.low & kLow, a.low >> kDecodeLowShift);
    const uint unset = a.last == b.first ? repeated : kDecodeLowSet;
    const uint low = b.low >> kDecodeLowShift;
    both.low = (a.low & kLow) | blend(all_if(low, kDecodeLowSet), low, unset) << kDecodeLowShift;
  }
  both.row = later(both.row, b.row, kDecodeRowSet, kDecodeRowSet | 0x7FF);
  both.row = later(both.row, b.row, kDecodeOtherSet, kDecodeOtherSet | kDecodeOther);
  const uint moved = min((a.base & 0xFFFF) + (b.base & 0xFFFF), kDecodeLastBase);
  both.base = blend(all_if(b.base, kDecodeBaseSet), b.base, (a.base & ~0xFFFFu) | moved);
  return both;
}

uint64_t loops_of(DecodeState state) { return packUint2x32(uvec2(state.loops_low, state.loops_high)); }
void add_loops(inout DecodeState state, uint wraps) {
  const uvec2 loops = unpackUint2x32(loops_of(state) + wraps);
  state.loops_low = loops.x;
  state.loops_high = loops.y;
}

// The state behind the words of a summary.
DecodeState state_behind(DecodeState state, DecodeSummary words) {
  const uint pre = words.low;
  const uint post = words.low >> kDecodeLowShift;
  state.time_low = blend(all_if(pre, kDecodeLowSet), pre & 0xFFF, state.time_low);
  if (words.first != kDecodeNone) {
    add_loops(state, words.wraps + is_wrap(state.time_high, words.first));
    if (words.first != state.time_high) state.time_low = 0;
    state.time_low = blend(all_if(post, kDecodeLowSet), post & 0xFFF, state.time_low);
    state.time_high = words.last;
  }
  state.y = blend(all_if(words.row, kDecodeRowSet), words.row & 0x7FF, state.y);
  state.other = blend(all_if(words.row, kDecodeOtherSet), bit_of(words.row, findMSB(kDecodeOther)), state.other);
  const uint base_set = all_if(words.base, kDecodeBaseSet);
  const uint moved = min(state.base_x + (words.base & 0xFFFF), kDecodeLastBase);
  state.base_x = blend(base_set, words.base & 0xFFFF, moved);
  state.base_p = blend(base_set, bit_of(words.base, findMSB(kDecodeBasePolarity)), state.base_p);
  return state;
}
