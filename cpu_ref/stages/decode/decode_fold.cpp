// Twins of shaders/decode/decode_fold.comp and decode_scan.comp.
#include <algorithm>

#include "cpu_ref/stages/decode/decode.h"

namespace scarf::stages {

namespace {

using layout::DecodeState;
using layout::DecodeSummary;

bool is_wrap(uint32_t format, uint32_t before, uint32_t high) {
  const uint32_t half_range = format == layout::kDecodeEvt2 ? 1u << 27 : 1u << 11;
  return high < before && before - high >= half_range;
}

void add_high(uint32_t format, DecodeSummary& s, uint32_t high) {
  if (s.first == layout::kDecodeNone) {
    s.first = s.last = high;
  } else if (high != s.last) {
    s.wraps += is_wrap(format, s.last, high) ? 1 : 0;
    s.last = high;
    s.low = (s.low & 0x1FFF) | layout::kDecodeLowSet << layout::kDecodeLowShift;
  }
}

void add_word(uint32_t format, DecodeSummary& s, uint32_t word) {
  if (format == layout::kDecodeEvt2) {
    if (word >> 28 == 0x8) add_high(format, s, word & 0x0FFFFFFF);
    return;
  }
  const uint32_t low = (word & 0xFFF) | layout::kDecodeLowSet;
  const auto move_base = [&](uint32_t by) {
    s.base = (s.base & ~0xFFFFu) | std::min((s.base & 0xFFFF) + by, layout::kDecodeLastBase);
  };
  switch (word >> 12) {
    case 0x0:
      s.row = (word & 0x7FF) | layout::kDecodeRowSet | layout::kDecodeOtherSet;
      break;
    case 0x1:
      s.row |= layout::kDecodeOther | layout::kDecodeOtherSet;
      break;
    case 0x3:
      s.base = (word & 0x7FF) | (word >> 11 & 1) * layout::kDecodeBasePolarity | layout::kDecodeBaseSet;
      break;
    case 0x4:
      move_base(12);
      break;
    case 0x5:
      move_base(8);
      break;
    case 0x6:
      s.low = s.first == layout::kDecodeNone ? low : (s.low & 0x1FFF) | low << layout::kDecodeLowShift;
      break;
    case 0x8:
      add_high(format, s, word & 0xFFF);
      break;
    default:
      break;
  }
}

DecodeState state_behind(uint32_t format, DecodeState state, const DecodeSummary& s) {
  if ((s.low & layout::kDecodeLowSet) != 0) state.time_low = s.low & 0xFFF;
  if (s.first != layout::kDecodeNone) {
    const uint64_t loops = (state.loops_low | uint64_t{state.loops_high} << 32) + s.wraps +
                           (is_wrap(format, state.time_high, s.first) ? 1 : 0);
    state.loops_low = static_cast<uint32_t>(loops);
    state.loops_high = static_cast<uint32_t>(loops >> 32);
    if (s.first != state.time_high) state.time_low = 0;
    const uint32_t behind = s.low >> layout::kDecodeLowShift;
    if ((behind & layout::kDecodeLowSet) != 0) state.time_low = behind & 0xFFF;
    state.time_high = s.last;
  }
  if ((s.row & layout::kDecodeRowSet) != 0) state.y = s.row & 0x7FF;
  if ((s.row & layout::kDecodeOtherSet) != 0) state.other = (s.row & layout::kDecodeOther) != 0 ? 1 : 0;
  const bool set = (s.base & layout::kDecodeBaseSet) != 0;
  if (set) state.base_p = (s.base & layout::kDecodeBasePolarity) != 0 ? 1 : 0;
  state.base_x = std::min((set ? 0 : state.base_x) + (s.base & 0xFFFF), layout::kDecodeLastBase);
  return state;
}

constexpr DecodeSummary kNoWords = {layout::kDecodeNone, layout::kDecodeNone, 0, 0, 0, 0};

}  // namespace

void decode_fold(const DecodeInput& input, std::span<const uint32_t> lane_skips,
                 std::span<const uint32_t> block_skips, std::span<DecodeSummary> lane_summaries,
                 std::span<DecodeSummary> block_summaries) {
  for (uint32_t block = 0; block < input.push.blocks; ++block) {
    DecodeSummary summary = kNoWords;
    uint32_t skip = 0;
    for (uint32_t k = 0; k < layout::kDecodeBlock; ++k) {
      const uint32_t i = block * layout::kDecodeBlock + k;
      const uint32_t lane = i / layout::kDecodeRun;
      if (k % layout::kDecodeRun == 0) {
        lane_summaries[lane] = summary;
        if (input.format == layout::kDecodeEvt2) skip = lane_skips[lane] >> 4 * block_skips[block] & 7;
      }
      if (i >= input.push.words) continue;
      const uint32_t word = input.words[i];
      if (skip > 0) {
        --skip;
        continue;
      }
      if (input.format == layout::kDecodeEvt2 && word >> 28 == 0xD) skip = layout::kDecodeImuSkip;
      add_word(input.format, summary, word);
    }
    block_summaries[block] = summary;
  }
}

void decode_scan(uint32_t format, std::span<const DecodeSummary> block_summaries,
                 std::span<DecodeState> block_states, layout::DecodeCarry& carry) {
  for (size_t block = 0; block < block_summaries.size(); ++block) {
    block_states[block] = carry.state;
    carry.state = state_behind(format, carry.state, block_summaries[block]);
  }
}

}  // namespace scarf::stages
