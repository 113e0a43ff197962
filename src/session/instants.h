// When frames of a recording are due.
//
// "The state at time T" is the state just before the first event, in arrival order, with t >= T. A frame of a
// clock is due when such an event arrives, also if nothing changed meanwhile. All events here are inside the
// sensor: those outside never move time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf {

/// A picture that is due: the state after the first `events` events of the stream.
struct Frame {
  int64_t t = 0;        ///< the T that was asked for; without one, the time of the last event shown
  uint64_t events = 0;  ///< events inside the sensor, counted from the start of the stream

  friend bool operator==(const Frame&, const Frame&) = default;
};

/// Takes a frame that is due. Its error ends the search for more.
using TakeFrame = std::function<Result<void>(const Frame&)>;

/// Tells the frames of a stream as its events come by.
class Instants {
 public:
  virtual ~Instants() = default;
  /// Hands over the frames that the next events of the stream make due, in order.
  /// Errors: bad_input if a single event makes more frames due than the limit; any error of `take`.
  virtual Result<void> due(std::span<const Event> events, const TakeFrame& take) = 0;
  /// Hands over the frames that are due because the stream has ended.
  virtual Result<void> due_at_end(const TakeFrame& take) = 0;
};

/// Frames per second as a fraction, so that no frame of a long recording is off by a rounding error.
struct FrameRate {
  uint64_t numerator = 30;
  uint64_t denominator = 1;
};
/// A decimal number with up to 6 decimals, 0.000001 to 1000000. Errors: illegal_parameter.
Result<FrameRate> parse_frame_rate(const std::string& word);

/// The frame clock T_i = t_first + floor(i * 1e6 / rate), i = 1, 2, ... An event that makes more than
/// `max_empty` frames due at once, between which there is no event, ends it.
std::unique_ptr<Instants> frames_at_rate(FrameRate rate, uint64_t max_empty);
/// A frame after every n events, n >= 1.
std::unique_ptr<Instants> frames_every(uint64_t n);
/// The state at each of the given times (ascending). Times after the last event show the final state.
std::unique_ptr<Instants> frames_at_times(std::vector<int64_t> times);
/// One frame: the final state.
std::unique_ptr<Instants> frame_at_end();

/// Where the times stand in a text file, and what they count.
struct TimesFormat {
  uint64_t column = 1;  ///< columns are separated by blanks, tabs or commas
  int exponent = 0;     ///< they count 10^exponent microseconds
};
/// "s", "ms", "us" or "ns" as TimesFormat::exponent. Errors: illegal_parameter.
Result<int> parse_time_unit(const std::string& word);

/// Times out of a text file, one per line and rising, rounded to microseconds. Empty lines and lines that
/// begin with # are left out. Errors: io; bad_input, naming the line.
Result<std::vector<int64_t>> read_times(const std::string& path, const TimesFormat& format = {});

}  // namespace scarf
