// Events packed for the way to a device: about 4 bytes each instead of 16, and nothing is lost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scarf/core/event.h"
#include "shaders/decode/unpack_layout.h"

namespace scarf {

/// Fills memory with blocks of up to 256 events; the layout is in shaders/decode/unpack_layout.h. Within a
/// block times are offsets from its earliest one, so that each event can be unpacked by itself, and
/// back-steps cost nothing. How many bits a word has for them depends on the sensor: 10 at 1280x720, 3 at
/// 16,384x16,384. A block whose times are too far apart for that has 1 or 2 bytes more per event; one that
/// spans still more, or has an event that no word can hold (one far outside the sensor), is stored as it is.
class EventPacker {
 public:
  /// Words of memory for `most_events` events in the worst case, and any parts of them.
  static size_t memory_words(uint32_t most_events);

  EventPacker() = default;
  /// `memory`: memory_words(most_events) words, which outlive the packer.
  EventPacker(SensorSize sensor, uint32_t* memory, uint32_t most_events);

  /// Events that can still be appended.
  size_t room() const;
  /// At most room() events.
  void append(std::span<const Event> events);

  /// Events appended since the last part, packed to the last one. Calling it again packs again.
  struct Part {
    layout::UnpackPush push;
    size_t table_begin;  ///< words
    size_t table_words;
    size_t data_begin;
    size_t data_words;
  };
  Part part();
  /// What is appended from now on is a new part.
  void end_part();
  /// Empty again.
  void restart();

 private:
  size_t pack_block(std::span<const Event> events);
  uint32_t most_blocks() const { return most_blocks_of(most_events_); }
  static uint32_t most_blocks_of(uint32_t most_events);

  uint32_t* memory_ = nullptr;
  uint32_t most_events_ = 0;
  uint32_t x_bits_ = 0;
  uint32_t y_bits_ = 0;
  uint32_t events_ = 0;       // appended
  uint32_t blocks_ = 0;       // packed
  size_t end_ = 0;            // word behind the last packed block
  uint32_t part_events_ = 0;  // where the current part begins
  uint32_t part_block_ = 0;
  size_t part_begin_ = 0;
  std::array<Event, layout::kPackedBlock> open_;  // events behind the last whole block
  size_t open_count_ = 0;
};

}  // namespace scarf
