// Twins of shaders/decode/decode_count.comp, decode_total.comp and decode_write.comp.
#include <algorithm>
#include <limits>

#include "cpu_ref/stages/decode/decode.h"

namespace scarf::stages {

namespace {

using layout::DecodeFacts;
using layout::DecodeState;

constexpr DecodeFacts kNoEvents = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, std::numeric_limits<int64_t>::max(), -1};

// Walks one block of words from the state in front of it.
class BlockWalk {
 public:
  BlockWalk(const DecodeInput& input, DecodeState state, uint32_t skip)
      : evt2_(input.format == layout::kDecodeEvt2), s_(state), skip_(skip) {}

  // Calls `emit` with each event of the word, on the sensor or not; returns whether the word is undefined.
  template <class Emit>
  bool next(uint32_t word, Emit emit) {
    return evt2_ ? next_evt2(word, emit) : next_evt3(word, emit);
  }

  uint32_t gaps() const { return gaps_; }

 private:
  int64_t time() const {
    const uint64_t loops = s_.loops_low | uint64_t{s_.loops_high} << 32;
    const uint64_t t = evt2_ ? loops << 34 | uint64_t{s_.time_high} << 6 | s_.time_low
                             : loops << 24 | uint64_t{s_.time_high} << 12 | s_.time_low;
    return static_cast<int64_t>(t & INT64_MAX);
  }
  Event event(uint32_t x, uint32_t p) const {
    return {time(), static_cast<uint16_t>(x), static_cast<uint16_t>(s_.y), static_cast<uint8_t>(p)};
  }
  void set_time_high(uint32_t high) {
    if (high == s_.time_high) return;
    if (!evt2_ && ((high - s_.time_high) & 0xFFF) != 1) ++gaps_;
    const uint32_t half_range = evt2_ ? 1u << 27 : 1u << 11;
    if (high < s_.time_high && s_.time_high - high >= half_range && ++s_.loops_low == 0) ++s_.loops_high;
    s_.time_high = high;
    s_.time_low = 0;
  }

  template <class Emit>
  bool next_evt2(uint32_t word, Emit emit) {
    if (skip_ > 0) {
      --skip_;
      return false;
    }
    switch (word >> 28) {
      case 0x0:
      case 0x1:
        s_.time_low = word >> 22 & 63;
        s_.y = word & 0x7FF;
        emit(event(word >> 11 & 0x7FF, word >> 28));
        return false;
      case 0x8:
        set_time_high(word & 0x0FFFFFFF);
        return false;
      case 0xD:
        skip_ = layout::kDecodeImuSkip;
        return false;
      case 0xA:
      case 0xE:
      case 0xF:
        return false;
      default:
        return true;
    }
  }

  template <class Emit>
  bool next_evt3(uint32_t word, Emit emit) {
    const uint32_t type = word >> 12;
    const uint32_t payload = word & 0xFFF;
    switch (type) {
      case 0x0:
        s_.y = payload & 0x7FF;
        s_.other = 0;
        return false;
      case 0x1:
        s_.other = 1;
        return false;
      case 0x2:
        if (s_.other == 0) emit(event(payload & 0x7FF, payload >> 11));
        return false;
      case 0x3:
        s_.base_x = payload & 0x7FF;
        s_.base_p = payload >> 11;
        return false;
      case 0x4:
      case 0x5: {
        const uint32_t length = type == 0x4 ? 12 : 8;
        for (uint32_t i = 0; i < length && s_.other == 0; ++i) {
          if ((payload >> i & 1) != 0) emit(event(s_.base_x + i, s_.base_p));
        }
        s_.base_x = std::min(s_.base_x + length, layout::kDecodeLastBase);
        return false;
      }
      case 0x6:
        s_.time_low = payload;
        return false;
      case 0x8:
        set_time_high(payload);
        return false;
      case 0x9:
        return word != 0x9999;
      default:
        return type == 0xB || type == 0xC;
    }
  }

  bool evt2_;
  DecodeState s_;
  uint32_t gaps_ = 0;
  uint32_t skip_;
};

bool is_inside(const Event& e, const layout::DecodePush& push) {
  return e.x < push.width && e.y < push.height;
}

// A step forward from the time `from`.
void note_jump(DecodeFacts& facts, int64_t step, int64_t from) {
  if (step <= facts.largest_jump) return;
  facts.largest_jump = step;
  facts.largest_jump_from = from;
}

void note(DecodeFacts& facts, const Event& e, bool inside) {
  if (facts.first < 0) facts.first = e.t;
  if (facts.last >= 0 && e.t - facts.last > layout::kDecodeLongestStep) {
    ++facts.jumps;
    note_jump(facts, e.t - facts.last, facts.last);
  }
  if (e.t < facts.last) {
    ++facts.back_steps;
    facts.largest_step = std::max(facts.largest_step, facts.last - e.t);
  }
  facts.last = e.t;
  ++(inside ? facts.inside : facts.outside);
  if (!inside) return;
  if (facts.first_inside < 0) facts.first_inside = e.t;
  facts.last_inside = e.t;
  facts.smallest = std::min(facts.smallest, e.t);
  facts.largest = std::max(facts.largest, e.t);
}

// Returns the gaps of the clock. Calls begin_lane(lane) in front of each run, word(unknown) behind each word
// and event(e) for each event.
template <class BeginLane, class OnWord, class OnEvent>
uint32_t walk_block(const DecodeInput& input, uint32_t block, BlockWalk walk, BeginLane begin_lane,
                    OnWord on_word, OnEvent on_event) {
  for (uint32_t k = 0; k < layout::kDecodeBlock; ++k) {
    const uint32_t i = block * layout::kDecodeBlock + k;
    if (k % layout::kDecodeRun == 0) begin_lane(i / layout::kDecodeRun);
    if (i < input.push.words) on_word(walk.next(input.words[i], on_event));
  }
  return walk.gaps();
}

BlockWalk walk_of(const DecodeInput& input, uint32_t block, std::span<const uint32_t> block_skips,
                  std::span<const DecodeState> block_states) {
  const uint32_t skip = input.format == layout::kDecodeEvt2 ? block_skips[block] : 0;
  return BlockWalk(input, block_states[block], skip);
}

}  // namespace

void decode_count(const DecodeInput& input, std::span<const uint32_t> block_skips,
                  std::span<const DecodeState> block_states, std::span<uint32_t> lane_places,
                  std::span<DecodeFacts> block_facts) {
  for (uint32_t block = 0; block < input.push.blocks; ++block) {
    DecodeFacts facts = kNoEvents;
    facts.gaps = walk_block(
        input, block, walk_of(input, block, block_skips, block_states),
        [&](uint32_t lane) { lane_places[lane] = facts.inside; },
        [&](bool unknown) { facts.unknown += unknown ? 1 : 0; },
        [&](const Event& e) { note(facts, e, is_inside(e, input.push)); });
    block_facts[block] = facts;
  }
}

void decode_total(std::span<const DecodeFacts> block_facts, std::span<uint32_t> block_places,
                  layout::DecodeResult& result, const layout::DecodeCarry& carry) {
  DecodeFacts all = kNoEvents;
  for (size_t i = 0; i < block_facts.size(); ++i) {
    const DecodeFacts& b = block_facts[i];
    block_places[i] = all.inside;
    all.inside += b.inside;
    all.outside += b.outside;
    all.unknown += b.unknown;
    all.gaps += b.gaps;
    const bool falls = b.first >= 0 && b.first < all.last;
    all.back_steps += b.back_steps + (falls ? 1 : 0);
    all.largest_step = std::max({all.largest_step, b.largest_step, falls ? all.last - b.first : 0});
    const bool leaps = b.first >= 0 && all.last >= 0 && b.first - all.last > layout::kDecodeLongestStep;
    all.jumps += b.jumps + (leaps ? 1 : 0);
    if (leaps) note_jump(all, b.first - all.last, all.last);
    note_jump(all, b.largest_jump, b.largest_jump_from);
    if (all.first < 0) all.first = b.first;
    if (b.last >= 0) all.last = b.last;
    if (all.first_inside < 0) all.first_inside = b.first_inside;
    if (b.last_inside >= 0) all.last_inside = b.last_inside;
    all.smallest = std::min(all.smallest, b.smallest);
    all.largest = std::max(all.largest, b.largest);
  }
  result = {all, carry.state.loops_low, carry.state.loops_high};
}

void decode_write(const DecodeInput& input, std::span<const uint32_t> block_skips,
                  std::span<const DecodeState> block_states, std::span<Event> events) {
  uint32_t place = 0;
  for (uint32_t block = 0; block < input.push.blocks; ++block) {
    walk_block(
        input, block, walk_of(input, block, block_skips, block_states), [](uint32_t) {}, [](bool) {},
        [&](const Event& e) {
          if (!is_inside(e, input.push)) return;
          if (place - input.push.first_event < input.push.events) events[place - input.push.first_event] = e;
          ++place;
        });
  }
}

}  // namespace scarf::stages
