// EVT2: Prophesee's format of 32-bit words, each with its type in the upper four bits.
// Source: Prophesee, "EVT 2.0 Format".
#pragma once

#include <cstdint>

#include "io/evt/high_counter.h"

namespace scarf::evt2 {

enum Type : uint32_t {
  kOff = 0x0,       // time b27..22 (lower six bits), x b21..11, y b10..0
  kOn = 0x1,        // the same
  kTimeHigh = 0x8,  // b27..0: the time's bits 33..6
  kTrigger = 0xA,   // time b27..22, input b12..8, value b0
  kImu = 0xD,       // begins a block of kImuWords words
  kOthers = 0xE,
  kContinued = 0xF,
};

inline constexpr uint32_t kImuWords = 6;
inline constexpr int kTimeLowBits = 6;
inline constexpr int kTimeHighBits = 28;
inline constexpr uint32_t kTimeHighsPerSecond = 1'000'000 >> kTimeLowBits;
inline constexpr uint32_t kTimeLowMask = (1 << kTimeLowBits) - 1;
inline constexpr uint32_t kCoordinateMask = 0x7FF;
inline constexpr uint32_t kTriggerInputMask = 0x1F;

/// The first time that a file cannot hold.
inline constexpr int64_t kTimeEnd = static_cast<int64_t>(kMaxLoops << (kTimeHighBits + kTimeLowBits));

using TimeHigh = HighCounter<kTimeHighBits>;

/// The clock of EVT2, EVT2.1 and EVT4: 28 upper bits in words of their own, six lower ones in each event.
class Clock {
 public:
  /// Whether there was a TIME_HIGH word; words before the first one do not count.
  bool started() const { return time_ >= 0; }
  void set_high(uint32_t value) {
    high_.set(value & (TimeHigh::kRange - 1));
    time_ = static_cast<int64_t>((high_.unwrapped() << kTimeLowBits) & INT64_MAX);
    if (first_high_ < 0) first_high_ = time_;
  }
  /// Microseconds, of an event with these lower bits.
  int64_t time(uint32_t low) const { return time_ | (low & kTimeLowMask); }
  /// The time of the first TIME_HIGH; negative before it.
  int64_t first_high() const { return first_high_; }

 private:
  TimeHigh high_;
  int64_t time_ = -1;
  int64_t first_high_ = -1;
};

/// The clock of a reader, as the writer of its file keeps it.
class HeldClock {
 public:
  /// Calls `emit` with the upper bits that must be written for the reader to come to time t (microseconds, at
  /// least 0). Returns the lower ones, for the event.
  template <class Emit>
  uint32_t set(int64_t t, Emit emit) {
    high_.carry_to(static_cast<uint64_t>(t) >> kTimeLowBits, emit);
    return static_cast<uint32_t>(t & kTimeLowMask);
  }

 private:
  HeldHigh<kTimeHighBits> high_;
};

}  // namespace scarf::evt2
