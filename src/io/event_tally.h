// Counts what every reader reports of its events, and drops the events outside the sensor.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "scarf/io.h"

namespace scarf {

class EventTally {
 public:
  explicit EventTally(std::optional<SensorSize> sensor) : sensor_(sensor) {
    constexpr int32_t kEverything = std::numeric_limits<uint16_t>::max() + 1;
    limit_ = sensor.value_or(SensorSize{kEverything, kEverything});
  }

  std::optional<SensorSize> sensor() const { return sensor_; }

  /// Counts the next events of the file and moves those inside the sensor to the front; returns their number.
  size_t keep(std::span<Event> events) {
    size_t kept = 0;
    for (const Event e : events) {
      note_time(e.t);
      events[kept] = e;
      kept += limit_.contains(e) ? 1 : 0;
    }
    report.events += kept;
    report.outside += events.size() - kept;
    return kept;
  }

  /// Counts the next event of the file, one whose coordinates no Event can hold.
  void drop(int64_t t) {
    note_time(t);
    ++report.outside;
  }

  ReadReport report;

 private:
  void note_time(int64_t t) {
    if (t < previous_) [[unlikely]] {
      // Unsigned: the distance of two hostile times may not fit a signed difference.
      const auto step = static_cast<int64_t>(static_cast<uint64_t>(previous_) - static_cast<uint64_t>(t));
      ++report.back_steps;
      report.largest_back_step = std::max(report.largest_back_step, step);
    }
    previous_ = t;
  }

  std::optional<SensorSize> sensor_;
  SensorSize limit_;
  int64_t previous_ = std::numeric_limits<int64_t>::min();
};

}  // namespace scarf
