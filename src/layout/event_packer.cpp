#include "layout/event_packer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/ceil_div.h"

namespace scarf {
namespace {

using layout::kPackedBlock;
using layout::kPackedRaw;
using layout::kPackedTableWords;

constexpr size_t kEventWords = sizeof(Event) / sizeof(uint32_t);
// Parts that may end within a block before the memory counts as full.
constexpr uint32_t kShortBlocks = 64;

// Events of a block as numbers, two for each: its time; and x, y and p in bits 0, 16 and 32. In this form
// loops over events become vector code.
using Numbers = std::array<uint64_t, 2 * kPackedBlock>;

// All bits that are set in any event: in its offset from a time, and in its second number.
struct Bits {
  uint64_t offset = 0;
  uint64_t place = 0;
};

Bits bits_of(const Numbers& numbers, size_t count, uint64_t base) {
  Bits all;
  for (size_t i = 0; i < count; ++i) {
    all.offset |= numbers[2 * i] - base;
    all.place |= numbers[2 * i + 1];
  }
  return all;
}

uint64_t earliest_of(std::span<const Event> events) {
  int64_t earliest = events.front().t;
  for (const Event& e : events) earliest = std::min(earliest, e.t);
  return static_cast<uint64_t>(earliest);
}

}  // namespace

uint32_t EventPacker::most_blocks_of(uint32_t most_events) {
  return ceil_div(most_events, kPackedBlock) + kShortBlocks;
}

size_t EventPacker::memory_words(uint32_t most_events) {
  return size_t{most_blocks_of(most_events)} * kPackedTableWords + most_events * kEventWords;
}

EventPacker::EventPacker(SensorSize sensor, uint32_t* memory, uint32_t most_events)
    : memory_(memory),
      most_events_(most_events),
      x_bits_(static_cast<uint32_t>(std::bit_width(static_cast<uint32_t>(sensor.width - 1)))),
      y_bits_(static_cast<uint32_t>(std::bit_width(static_cast<uint32_t>(sensor.height - 1)))) {
  restart();
}

void EventPacker::restart() {
  events_ = blocks_ = part_events_ = part_block_ = 0;
  end_ = part_begin_ = size_t{most_blocks()} * kPackedTableWords;
  open_count_ = 0;
}

size_t EventPacker::room() const {
  const size_t in_blocks = size_t{most_blocks() - blocks_} * kPackedBlock - open_count_;
  return std::min<size_t>(most_events_ - events_, in_blocks);
}

void EventPacker::append(std::span<const Event> events) {
  events_ += static_cast<uint32_t>(events.size());
  while (!events.empty()) {
    if (open_count_ == 0 && events.size() >= kPackedBlock) {
      end_ += pack_block(events.first(kPackedBlock));
      ++blocks_;
      events = events.subspan(kPackedBlock);
      continue;
    }
    const size_t count = std::min(events.size(), kPackedBlock - open_count_);
    std::copy_n(events.begin(), count, open_.begin() + static_cast<std::ptrdiff_t>(open_count_));
    open_count_ += count;
    events = events.subspan(count);
    if (open_count_ == kPackedBlock) {
      end_ += pack_block(open_);
      ++blocks_;
      open_count_ = 0;
    }
  }
}

EventPacker::Part EventPacker::part() {
  size_t end = end_;
  uint32_t blocks = blocks_;
  if (open_count_ > 0) {
    end += pack_block(std::span(open_).first(open_count_));
    ++blocks;
  }
  return {{part_block_, events_ - part_events_, x_bits_, y_bits_},
          size_t{part_block_} * kPackedTableWords,
          size_t{blocks - part_block_} * kPackedTableWords,
          part_begin_,
          end - part_begin_};
}

void EventPacker::end_part() {
  if (open_count_ > 0) {
    end_ += pack_block(std::span(open_).first(open_count_));
    ++blocks_;
    open_count_ = 0;
  }
  part_events_ = events_;
  part_block_ = blocks_;
  part_begin_ = end_;
}

// Writes block number blocks_ to word end_; returns its words.
size_t EventPacker::pack_block(std::span<const Event> events) {
  const uint32_t place_bits = x_bits_ + y_bits_ + 1;
  const uint32_t time_bits = 32 - place_bits;
  const size_t count = events.size();
  Numbers numbers;
  std::memcpy(numbers.data(), events.data(), events.size_bytes());
  // The first event is mostly the earliest; if it is not, its offsets are too long.
  uint64_t base = numbers[0];
  Bits bits = bits_of(numbers, count, base);
  if (bits.offset >> time_bits != 0) {
    base = earliest_of(events);
    bits = bits_of(numbers, count, base);
  }
  const bool fits = (bits.place & 0xFFFF) >> x_bits_ == 0 && (bits.place >> 16 & 0xFFFF) >> y_bits_ == 0 &&
                    (bits.place >> 32 & 0xFF) <= 1;
  uint32_t form = 0;
  while (form < kPackedRaw && (!fits || bits.offset >> (time_bits + 8 * form) != 0)) ++form;

  uint32_t* const table = memory_ + size_t{blocks_} * kPackedTableWords;
  table[0] = static_cast<uint32_t>(end_) << 2 | form;
  table[1] = static_cast<uint32_t>(base);
  table[2] = static_cast<uint32_t>(base >> 32);
  uint32_t* const words = memory_ + end_;
  if (form == kPackedRaw) {
    std::memcpy(words, events.data(), events.size_bytes());
    return count * kEventWords;
  }
  const uint32_t x_bits = x_bits_;  // a local: nothing that is written may change it
  for (size_t i = 0; i < count; ++i) {
    const uint64_t place = numbers[2 * i + 1];
    words[i] =
        static_cast<uint32_t>((place & 0xFFFF) | (place >> 16 & 0xFFFF) << x_bits |
                              (place >> 32 & 1) << (place_bits - 1) | (numbers[2 * i] - base) << place_bits);
  }
  auto* const more = reinterpret_cast<uint8_t*>(words + count);
  if (form == 1) {
    for (size_t i = 0; i < count; ++i) {
      more[i] = static_cast<uint8_t>((numbers[2 * i] - base) >> time_bits);
    }
  } else if (form == 2) {
    for (size_t i = 0; i < count; ++i) {
      const uint64_t high = (numbers[2 * i] - base) >> time_bits;
      more[2 * i] = static_cast<uint8_t>(high);
      more[2 * i + 1] = static_cast<uint8_t>(high >> 8);
    }
  }
  return count + ceil_div(count * form, sizeof(uint32_t));
}

}  // namespace scarf
