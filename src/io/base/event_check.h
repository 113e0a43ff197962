// The check of every event before it is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "scarf/core/event.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// What a format can hold.
struct WriteLimits {
  std::string_view format;
  int64_t t_min = std::numeric_limits<int64_t>::min();  ///< the earliest time ...
  int64_t t_end = std::numeric_limits<int64_t>::max();  ///< ... and the first one too late
  bool back_steps = false;                              ///< whether a time may be before the one before it
  int32_t max_coordinate = std::numeric_limits<uint16_t>::max();
  uint32_t trigger_inputs = 0;  ///< how many inputs of triggers it tells apart; 0: no room for triggers
  bool header = false;          ///< whether there is room for lines of a camera's header
};

class EventCheck {
 public:
  EventCheck(SensorSize sensor, const WriteLimits& limits)
      : sensor_(sensor), limits_(limits), previous_t_(limits.t_min) {}

  /// For formats whose range of times depends on the first event.
  void set_t_end(int64_t t_end) { limits_.t_end = t_end; }
  /// Events accepted so far.
  uint64_t count() const { return count_; }
  bool accepts(const Event& event) const { return objection(event).empty(); }
  /// How many of the next events, from the front, can be written.
  size_t accepted(std::span<const Event> events);
  /// What is said of the event behind those that were accepted.
  Error refusal(const std::string& path, const Event& event) const;

  /// Accepts a trigger between the events before it and those behind it. Errors: bad_input, if the format
  /// cannot hold it there.
  Result<void> accept(const std::string& path, const Trigger& trigger);
  /// Errors: bad_input, if the format has no room for the camera's header.
  Result<void> accept_header(const std::string& path) const;

 private:
  std::string_view objection(const Event& event) const;
  std::string_view objection(const Trigger& trigger) const;

  SensorSize sensor_;
  WriteLimits limits_;
  uint64_t count_ = 0;
  uint64_t triggers_ = 0;
  int64_t previous_t_;
};

}  // namespace scarf
