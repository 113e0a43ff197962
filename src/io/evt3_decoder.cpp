#include "io/evt3_decoder.h"

#include <algorithm>

#include "core/little_endian.h"
#include "io/put_event.h"

namespace scarf::evt3 {
namespace {

constexpr size_t kWordBytes = 2;

// yes ? a : b, in a form that compilers do not turn into a branch.
uint32_t select(bool yes, uint32_t a, uint32_t b) {
  return b ^ ((a ^ b) & (0 - uint32_t{yes}));
}

constexpr uint32_t kSingles = 1 << kAddrY | 1 << kAddrX | 1 << kTimeLow;

bool is_single(uint32_t word) {
  return (kSingles >> (word >> 12) & 1) != 0;
}

uint32_t word_at(std::span<const uint8_t> bytes, size_t at) {
  return load_little_endian<uint16_t>(bytes.data() + at);
}

}  // namespace

size_t Clock::start(std::span<const uint8_t> bytes) {
  size_t at = 0;
  for (; !started_ && at + kWordBytes <= bytes.size(); at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    const uint32_t type = word >> 12;
    if (type == kTimeHigh) {
      set_high(word & kPayloadMask);
      started_ = start_ == Start::time_high;
    } else if (type == kTimeLow && high_seen_) {
      set_low(word & kPayloadMask);
      started_ = true;
    }
  }
  return at;
}

void Clock::set_high(uint32_t value) {
  if (high_seen_) {
    if (value == high_.value()) return;
    gaps_ += ((value - high_.value()) & kPayloadMask) == 1 ? 0 : 1;
  }
  high_seen_ = true;
  high_.set(value);
  low_ = 0;
  base_ = static_cast<int64_t>((high_.unwrapped() << kTimeLowBits) & INT64_MAX);
  if (first_high_ < 0) first_high_ = std::max<int64_t>(base_ - (int64_t{1} << kTimeLowBits), 0);
}

std::optional<int64_t> Clock::first_high() const {
  return first_high_ < 0 ? std::nullopt : std::optional(first_high_);
}

void EventDecoder::set_vector(uint32_t mask, uint32_t length) {
  // Beyond every sensor the base stops, so that coordinates never wrap back into it.
  constexpr uint32_t kLastBase = 0xF000;
  vector_.bits = brightness_ ? mask : 0;
  put_event(vector_.first, clock_.time(), base_x_, y_, base_p_);
  base_x_ = std::min(base_x_ + length, kLastBase);
}

// The words that most streams consist of: rows, columns, times. They come in an order that no branch
// predictor learns, hence without a branch: an event is written for every word, though counted for columns
// only. Returns the bytes taken: up to the first other word, but TIME_HIGH with the value it had.
size_t EventDecoder::decode_singles(std::span<const uint8_t> bytes, std::span<Event> out, size_t& events) {
  const uint32_t repeated_high = uint32_t{kTimeHigh} << 12 | clock_.high();
  const int64_t base = clock_.base();
  uint32_t y = y_;
  uint32_t low = clock_.low();
  size_t count = 0;
  // Each word is at most one event, so that there is always room.
  const size_t end = std::min(bytes.size() / kWordBytes, out.size()) * kWordBytes;
  size_t at = 0;
  for (; at < end; at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    const uint32_t type = word >> 12;
    // One branch for both conditions: which of them holds is not predictable either.
    const uint32_t other = ~kSingles >> type & uint32_t{word != repeated_high};
    if (other != 0) break;
    put_event(out[count], base | low, word & kCoordinateMask, y, word >> 11 & 1);
    count += type == kAddrX ? 1 : 0;
    y = select(type == kAddrY, word & kCoordinateMask, y);
    low = select(type == kTimeLow, word & kPayloadMask, low);
  }
  y_ = y;
  clock_.set_low(low);
  events = count;
  return at;
}

// The words of a row that is not of brightness changes, of which only times matter. Returns the bytes taken:
// up to the next row.
size_t EventDecoder::skip_row(std::span<const uint8_t> bytes) {
  size_t at = 0;
  for (; at + kWordBytes <= bytes.size(); at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    const uint32_t type = word >> 12;
    if (type == kAddrY) {
      brightness_ = true;
      break;
    }
    if (type == kTimeLow) clock_.set_low(word & kPayloadMask);
    if (!is_single(word)) take(word);
  }
  return at;
}

// A word that is not of decode_singles.
void EventDecoder::take(uint32_t word) {
  switch (word >> 12) {
    case kOtherAddrY:
      brightness_ = false;
      break;
    case kVectBaseX:
      base_x_ = word & kCoordinateMask;
      base_p_ = word >> 11 & 1;
      break;
    case kVect12:
      set_vector(word & 0xFFF, 12);
      break;
    case kVect8:
      set_vector(word & 0xFF, 8);
      break;
    case kTimeHigh:
      clock_.set_high(word & kPayloadMask);
      break;
    case kContinued4:
    case kTrigger:
    case kImu:
    case kOthers:
    case kContinued12:
      break;
    default:
      unknown_ += word == kFillerWord ? 0 : 1;
  }
}

EventDecoder::Decoded EventDecoder::decode(std::span<const uint8_t> bytes, std::span<Event> out) {
  size_t at = clock_.start(bytes);
  size_t count = vector_.write(out);
  while (count < out.size() && at + kWordBytes <= bytes.size()) {
    if (!brightness_) {
      at += skip_row(bytes.subspan(at));
      continue;
    }
    size_t events = 0;
    at += decode_singles(bytes.subspan(at), out.subspan(count), events);
    count += events;
    for (; brightness_ && count < out.size() && at + kWordBytes <= bytes.size(); at += kWordBytes) {
      const uint32_t word = word_at(bytes, at);
      if (is_single(word)) break;
      take(word);
      count += vector_.write(out.subspan(count));
    }
  }
  return {at, count};
}

TriggerDecoder::Decoded TriggerDecoder::decode(std::span<const uint8_t> bytes, std::span<Trigger> out) {
  size_t at = clock_.start(bytes);
  size_t count = 0;
  for (; count < out.size() && at + kWordBytes <= bytes.size(); at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    const uint32_t type = word >> 12;
    if (type == kTimeLow) clock_.set_low(word & kPayloadMask);
    if (type == kTimeHigh) clock_.set_high(word & kPayloadMask);
    if (type == kTrigger) {
      out[count++] = {clock_.time(), static_cast<uint16_t>(word >> 8 & 0xF), static_cast<uint8_t>(word & 1)};
    }
  }
  return {at, count};
}

}  // namespace scarf::evt3
