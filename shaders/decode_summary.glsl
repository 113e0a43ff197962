// Joins what words do to a decoder's state; see DecodeSummary. Both functions follow the rules of docs/FORMATS.md:
// a fall of TIME_HIGH by half its range is a wrap; in EVT3 a new TIME_HIGH sets TIME_LOW to 0, a repeated one does not.
uint is_wrap(uint before, uint high) {
  const uint half_range = kFormat == kDecodeEvt2 ? 1u << 27 : 1u << 11;
  return high < before && before - high >= half_range ? 1 : 0;
}

uint later(uint before, uint behind, uint mark, uint field) {
  return (behind & mark) != 0 ? (before & ~field) | (behind & field) : before;
}

DecodeSummary no_words() { return DecodeSummary(kDecodeNone, kDecodeNone, 0, 0, 0, 0); }

// First a, then b.
DecodeSummary join_summaries(DecodeSummary a, DecodeSummary b) {
  const uint kLow = 0x1FFF;  // a TIME_LOW with its mark
  DecodeSummary both = a;
  if (b.first == kDecodeNone) {
    const uint shift = a.first == kDecodeNone ? 0 : kDecodeLowShift;
    if ((b.low & kDecodeLowSet) != 0) both.low = (a.low & ~(kLow << shift)) | (b.low & kLow) << shift;
  } else if (a.first == kDecodeNone) {
    both.first = b.first;
    both.last = b.last;
    both.wraps = b.wraps;
    both.low = (b.low & kDecodeLowSet) != 0 ? b.low : (b.low & ~kLow) | (a.low & kLow);
  } else {
    both.last = b.last;
    both.wraps = a.wraps + b.wraps + is_wrap(a.last, b.first);
    uint low = b.low >> kDecodeLowShift;
    if ((low & kDecodeLowSet) == 0 && a.last == b.first) {
      low = (b.low & kDecodeLowSet) != 0 ? b.low & kLow : a.low >> kDecodeLowShift;
    } else if ((low & kDecodeLowSet) == 0) {
      low = kDecodeLowSet;
    }
    both.low = (a.low & kLow) | low << kDecodeLowShift;
  }
  both.row = later(both.row, b.row, kDecodeRowSet, kDecodeRowSet | 0x7FF);
  both.row = later(both.row, b.row, kDecodeOtherSet, kDecodeOtherSet | kDecodeOther);
  const uint moved = min((a.base & 0xFFFF) + (b.base & 0xFFFF), kDecodeLastBase);
  both.base = (b.base & kDecodeBaseSet) != 0 ? b.base : (a.base & ~0xFFFFu) | moved;
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
  if ((pre & kDecodeLowSet) != 0) state.time_low = pre & 0xFFF;
  if (words.first != kDecodeNone) {
    add_loops(state, words.wraps + is_wrap(state.time_high, words.first));
    if (words.first != state.time_high) state.time_low = 0;
    if ((post & kDecodeLowSet) != 0) state.time_low = post & 0xFFF;
    state.time_high = words.last;
  }
  if ((words.row & kDecodeRowSet) != 0) state.y = words.row & 0x7FF;
  if ((words.row & kDecodeOtherSet) != 0) state.other = (words.row & kDecodeOther) != 0 ? 1 : 0;
  if ((words.base & kDecodeBaseSet) != 0) {
    state.base_x = words.base & 0xFFFF;
    state.base_p = (words.base & kDecodeBasePolarity) != 0 ? 1 : 0;
  } else {
    state.base_x = min(state.base_x + (words.base & 0xFFFF), kDecodeLastBase);
  }
  return state;
}
