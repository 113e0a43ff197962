// What every reader does with its events: counts them, applies the policies, drops those outside the sensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scarf/io/recordings.h"

namespace scarf {

/// Readers hand out no time further from 0 than this, so that differences and shifts fit 64 bits.
inline constexpr int64_t kMaxTime = int64_t{1} << 62;

class EventTally {
 public:
  EventTally(std::optional<SensorSize> sensor, const ReadOptions& options);

  std::optional<SensorSize> sensor() const { return sensor_; }
  bool strict() const { return strict_; }

  /// Takes the next events of the file, counts them and moves those that are handed out to the front; returns
  /// their number. After a failure nothing is handed out any more.
  size_t keep(std::span<Event> events);

  /// Counts the next event of the file, one whose coordinates no Event can hold.
  void drop(int64_t t);

  /// The time of the first TIME_HIGH, for TimeShift::first_high; before the first event.
  void set_first_high(int64_t t);

  /// Counts an event that is left out, as its format does not define its polarity; `unit` and `place` ("row",
  /// 7) say where it is. With ReadOptions::strict that is a failure.
  void leave_out_polarity(std::string_view unit, uint64_t place);

  /// Notes a broken place of the file. With ReadOptions::strict that is a failure.
  void note_damage(uint64_t byte, std::string what);

  /// Why reading ends: an event that the policies do not allow, or damage.
  const std::optional<Error>& failure() const { return failure_; }
  void fail(Error error);

  ReadReport report;

 private:
  static constexpr int64_t kNoTime = std::numeric_limits<int64_t>::min();

  bool is_plain(std::span<const Event> events) const;
  size_t keep_all(std::span<Event> events);
  size_t keep_by_policy(std::span<Event> events);
  bool in_order(Event& event);
  void set_shift(int64_t shift);
  void count_back_step(int64_t t);
  void count_jump(int64_t t);

  std::optional<SensorSize> sensor_;
  SensorSize limit_;
  TimePolicy time_policy_;
  OutOfSensor out_of_sensor_;
  TimeShift time_shift_;
  bool strict_;
  std::optional<int64_t> shift_;
  int64_t previous_ = kNoTime;
  std::optional<Error> failure_;
};

}  // namespace scarf
