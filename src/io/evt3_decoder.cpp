#include "io/evt3_decoder.h"

#include <algorithm>
#include <bit>

#include "core/little_endian.h"

namespace scarf::evt3 {
namespace {

constexpr size_t kWordBytes = 2;

// `yes` (0 or 1) ? a : b, in a form that compilers do not turn into a branch.
uint32_t select(uint32_t yes, uint32_t a, uint32_t b) {
  return b ^ ((a ^ b) & (0 - yes));
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
  vector_mask_ = brightness_ ? mask : 0;
  vector_x_ = base_x_;
  base_x_ = std::min(base_x_ + length, kLastBase);
}

size_t EventDecoder::write_vector(std::span<Event> out) {
  size_t count = 0;
  while (vector_mask_ != 0 && count < out.size()) {
    const auto x = static_cast<uint16_t>(vector_x_ + static_cast<uint32_t>(std::countr_zero(vector_mask_)));
    out[count++] = {clock_.time(), x, static_cast<uint16_t>(y_), static_cast<uint8_t>(base_p_)};
    vector_mask_ &= vector_mask_ - 1;
  }
  return count;
}

EventDecoder::Decoded EventDecoder::decode(std::span<const uint8_t> bytes, std::span<Event> out) {
  // A copy, so that the compiler can hold it in registers while events are written.
  EventDecoder s = *this;
  size_t at = s.clock_.start(bytes);
  size_t count = s.write_vector(out);
  for (; count < out.size() && at + kWordBytes <= bytes.size(); at += kWordBytes) {
    const uint32_t word = word_at(bytes, at);
    const uint32_t type = word >> 12;
    // Rows, columns and times come in an order that no branch predictor learns: hence without a branch.
    constexpr uint32_t kSingles = 1 << kAddrY | 1 << kAddrX | 1 << kTimeLow;
    if (kSingles >> type & 1) {
      out[count] = {s.clock_.time(), static_cast<uint16_t>(word & kCoordinateMask),
                    static_cast<uint16_t>(s.y_), static_cast<uint8_t>(word >> 11 & 1)};
      count += uint32_t{type == kAddrX} & s.brightness_;
      const uint32_t row = uint32_t{type == kAddrY};
      s.y_ = select(row, word & kCoordinateMask, s.y_);
      s.brightness_ |= row;
      s.clock_.set_low(select(uint32_t{type == kTimeLow}, word & kPayloadMask, s.clock_.low()));
      continue;
    }
    switch (type) {
      case kOtherAddrY:
        s.brightness_ = 0;
        break;
      case kVectBaseX:
        s.base_x_ = word & kCoordinateMask;
        s.base_p_ = word >> 11 & 1;
        break;
      case kVect12:
        s.set_vector(word & 0xFFF, 12);
        count += s.write_vector(out.subspan(count));
        break;
      case kVect8:
        s.set_vector(word & 0xFF, 8);
        count += s.write_vector(out.subspan(count));
        break;
      case kTimeHigh:
        s.clock_.set_high(word & kPayloadMask);
        break;
      case kContinued4:
      case kTrigger:
      case kImu:
      case kOthers:
      case kContinued12:
        break;
      default:
        s.unknown_ += word == kFillerWord ? 0 : 1;
    }
  }
  *this = s;
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
