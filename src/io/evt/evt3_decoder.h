// EVT3 words into events and triggers, apart from where the words come from (files, messages of ROS): the
// state is kept from one piece of the stream to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "io/evt/evt3.h"
#include "io/evt/pixel_mask.h"
#include "scarf/core/event.h"
#include "scarf/io/frames.h"

namespace scarf::evt3 {

/// From where on events and triggers count. Words before that are passed over unread.
enum class Start {
  time_high,          ///< from the first TIME_HIGH on; its lower bits are 0 until the first TIME_LOW
  time_high_and_low,  ///< from the first TIME_LOW behind the first TIME_HIGH on, as the ROS codec does
};

/// The camera's clock.
class Clock {
 public:
  explicit Clock(Start start) : start_(start) {}

  /// Whether words count yet.
  bool started() const { return started_; }
  /// Takes words until they count; returns the bytes taken.
  size_t start(std::span<const uint8_t> bytes);

  void set_high(uint32_t value);
  void set_low(uint32_t value) { low_ = value; }
  uint32_t low() const { return low_; }
  uint32_t high() const { return high_.value(); }
  /// Microseconds, without the lower bits.
  int64_t base() const { return base_; }
  /// Microseconds.
  int64_t time() const { return base_ | low_; }

  /// What TimeShift::first_high subtracts: the time of the TIME_HIGH before the first one (OpenEB's rule).
  std::optional<int64_t> first_high() const;
  /// Steps of TIME_HIGH other than to the same or the next value. Cameras send every value, so that data is
  /// missing there.
  uint64_t gaps() const { return gaps_; }

 private:
  Start start_;
  bool started_ = false;
  bool high_seen_ = false;
  TimeHigh high_;
  int64_t base_ = 0;         // of high_, microseconds
  int64_t first_high_ = -1;  // negative before it is known
  uint32_t low_ = 0;
  uint64_t gaps_ = 0;
};

class EventDecoder {
 public:
  explicit EventDecoder(Start start = Start::time_high) : clock_(start) {}

  struct Decoded {
    size_t bytes = 0;   ///< taken from the front of the input: whole words
    size_t events = 0;  ///< at the front of the output; fewer than fit: no whole word is left
  };

  /// Decodes words until `out` is full or no whole one is left.
  Decoded decode(std::span<const uint8_t> bytes, std::span<Event> out);

  const Clock& clock() const { return clock_; }
  /// Words so far that EVT3 does not define.
  uint64_t unknown_words() const { return unknown_; }

 private:
  size_t decode_common(std::span<const uint8_t> bytes, std::span<Event> out, size_t& events);
  size_t skip_row(std::span<const uint8_t> bytes);
  void take(uint32_t word);
  void set_vector(uint32_t mask, uint32_t length);

  Clock clock_;
  bool brightness_ = true;  // the row is of brightness changes, not of kOtherAddrY
  uint32_t y_ = 0;
  uint32_t base_x_ = 0;
  uint32_t base_p_ = 0;
  PixelMask vector_;  // events of the last vector that did not fit the output yet
  uint64_t unknown_ = 0;
};

class TriggerDecoder {
 public:
  explicit TriggerDecoder(Start start = Start::time_high) : clock_(start) {}

  struct Decoded {
    size_t bytes = 0;     ///< taken from the front of the input: whole words
    size_t triggers = 0;  ///< at the front of the output; fewer than fit: no whole word is left
  };

  /// Decodes words until `out` is full or no whole one is left.
  Decoded decode(std::span<const uint8_t> bytes, std::span<Trigger> out);

 private:
  Clock clock_;
};

}  // namespace scarf::evt3
