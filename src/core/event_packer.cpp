#include "core/event_packer.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "core/ceil_div.h"

namespace scarf {
namespace {

using layout::kPackedBlock;
using layout::kPackedRaw;
using layout::kPackedTableWords;

constexpr size_t kEventWords = sizeof(Event) / sizeof(uint32_t);
// Parts that may end within a block before the memory counts as full.
constexpr uint32_t kShortBlocks = 64;

struct Extent {
  int64_t earliest = std::numeric_limits<int64_t>::max();
  int64_t latest = std::numeric_limits<int64_t>::min();
  uint32_t x = 0;  // all bits that are set in any of them
  uint32_t y = 0;
  uint32_t p = 0;
};

Extent extent_of(std::span<const Event> events) {
  Extent all;
  for (const Event& e : events) {
    all.earliest = std::min(all.earliest, e.t);
    all.latest = std::max(all.latest, e.t);
    all.x |= e.x;
    all.y |= e.y;
    all.p |= e.p;
  }
  return all;
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
  const Extent extent = extent_of(events);
  const uint32_t place_bits = x_bits_ + y_bits_ + 1;
  const uint32_t time_bits = 32 - place_bits;
  const auto base = static_cast<uint64_t>(extent.earliest);
  const uint64_t span = static_cast<uint64_t>(extent.latest) - base;
  const bool fits = extent.x >> x_bits_ == 0 && extent.y >> y_bits_ == 0 && extent.p <= 1;
  uint32_t form = 0;
  while (form < kPackedRaw && (!fits || span >> (time_bits + 8 * form) != 0)) ++form;

  uint32_t* const table = memory_ + size_t{blocks_} * kPackedTableWords;
  table[0] = static_cast<uint32_t>(end_) << 2 | form;
  table[1] = static_cast<uint32_t>(base);
  table[2] = static_cast<uint32_t>(base >> 32);
  uint32_t* const words = memory_ + end_;
  const size_t count = events.size();
  if (form == kPackedRaw) {
    std::memcpy(words, events.data(), events.size_bytes());
    return count * kEventWords;
  }
  for (size_t i = 0; i < count; ++i) {
    const Event& e = events[i];
    const auto offset = static_cast<uint32_t>(static_cast<uint64_t>(e.t) - base);
    words[i] = e.x | uint32_t{e.y} << x_bits_ | uint32_t{e.p} << (place_bits - 1) | offset << place_bits;
  }
  auto* const more = reinterpret_cast<uint8_t*>(words + count);
  if (form == 1) {
    for (size_t i = 0; i < count; ++i) {
      more[i] = static_cast<uint8_t>((static_cast<uint64_t>(events[i].t) - base) >> time_bits);
    }
  } else if (form == 2) {
    for (size_t i = 0; i < count; ++i) {
      const uint64_t high = (static_cast<uint64_t>(events[i].t) - base) >> time_bits;
      more[2 * i] = static_cast<uint8_t>(high);
      more[2 * i + 1] = static_cast<uint8_t>(high >> 8);
    }
  }
  return count + ceil_div(count * form, sizeof(uint32_t));
}

}  // namespace scarf
