// What the decoders of recordings report, on the CPU and on a device.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scarf {

/// Where a recording is broken.
struct Damage {
  uint64_t byte = 0;  ///< of the file; in compressed files, of the packet or chunk that is broken
  std::string what;

  friend bool operator==(const Damage&, const Damage&) = default;
};

/// A step forward in time of more microseconds than this is a jump.
inline constexpr int64_t kLongestStep = 10'000'000;

/// What a reader met so far.
struct ReadReport {
  uint64_t events = 0;            ///< events handed out
  uint64_t outside = 0;           ///< events outside the sensor (or beyond uint16_t): counted and dropped
  uint64_t back_steps = 0;        ///< events (outside ones included) older than the event before them;
                                  ///< with TimePolicy clamp and drop: than the newest one so far
  int64_t largest_back_step = 0;  ///< microseconds
  uint64_t jumps = 0;  ///< events later by more than kLongestStep than what back-steps are measured against
  int64_t largest_jump = 0;       ///< microseconds
  int64_t largest_jump_from = 0;  ///< the time in front of the first one that large, as it is in the file
  int64_t time_shift = 0;         ///< microseconds subtracted from all times, by ReadOptions::time_shift
  uint64_t dropped = 0;           ///< events left out by TimePolicy::drop
  uint64_t gaps = 0;              ///< places where the file shows that data is missing
  uint64_t unknown_words = 0;     ///< words or lines that the format does not define
  uint64_t skipped = 0;  ///< records that the format has for other things than events (samples of frames and
                         ///< of the IMU, triggers), or marks as not valid: AEDAT 1 to 3
  uint64_t undefined_polarities = 0;  ///< events left out: the format does not define their polarity
  uint64_t truncated_bytes = 0;       ///< bytes at the end that do not make a whole word, line or packet
  uint64_t damages = 0;               ///< broken places that reading went around
  std::optional<Damage> damage;       ///< the first of them

  friend bool operator==(const ReadReport&, const ReadReport&) = default;
};

}  // namespace scarf
