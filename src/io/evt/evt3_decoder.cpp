#include "io/evt/evt3_decoder.h"

#include <algorithm>

#include "core/little_endian.h"
#include "io/base/put_event.h"
#include "io/evt/evt3_common_words.h"

namespace scarf::evt3 {
namespace {

constexpr size_t kWordBytes = 2;

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
  vector_.bits = brightness_ ? mask : 0;
  put_event(vector_.first, clock_.time(), base_x_, y_, base_p_);
  base_x_ = std::min(base_x_ + length, kLastVectorX);
}

size_t EventDecoder::decode_common(std::span<const uint8_t> bytes, std::span<Event> out, size_t& events) {
  Said said{clock_.base(), clock_.high(), clock_.low(), y_, base_x_, base_p_};
  const CommonWords decoded = decode_common_words(bytes, out, said);
  clock_.set_low(said.low);
  y_ = said.y;
  base_x_ = said.vector_x;
  base_p_ = said.vector_p;
  events = decoded.events;
  return decoded.bytes;
}

// The words of a row that is not of brightness changes, of which only times matter. Returns the bytes taken:
// up to the next row.
size_t EventDecoder::skip_row(std::span<const uint8_t> bytes) {
  size_t at = 0;
  for (; at + kWordBytes <= bytes.size(); at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    if (word >> 12 == kAddrY) {
      brightness_ = true;
      break;
    }
    take(word);
  }
  return at;
}

// A word that decode_common leaves, or one of a row that is not of brightness changes.
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
    case kTimeLow:
      clock_.set_low(word & kPayloadMask);
      break;
    case kTimeHigh:
      clock_.set_high(word & kPayloadMask);
      break;
    case kAddrY:
    case kAddrX:
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
    at += decode_common(bytes.subspan(at), out.subspan(count), events);
    count += events;
    if (count < out.size() && at + kWordBytes <= bytes.size()) {
      take(word_at(bytes, at));
      at += kWordBytes;
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
      out[count++] = {clock_.time(), static_cast<uint16_t>(word >> 8 & kTriggerInputMask),
                      static_cast<uint8_t>(word & 1)};
    }
  }
  return {at, count};
}

}  // namespace scarf::evt3
