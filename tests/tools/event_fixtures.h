// Streams of events for tests of the program's parts.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "scarf/io/recordings.h"

namespace scarf::tools {

/// Events with rising times, about one in 20 us, from a seed.
inline std::vector<Event> random_events(size_t count, SensorSize sensor, uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::vector<Event> events(count);
  int64_t t = 1'000'000;
  for (Event& e : events) {
    t += static_cast<int64_t>(random() % 40);
    e.t = t;
    e.x = static_cast<uint16_t>(random() % sensor.width);
    e.y = static_cast<uint16_t>(random() % sensor.height);
    e.p = static_cast<uint8_t>(random() % 2);
  }
  return events;
}

/// One event at each of the given times.
inline std::vector<Event> events_at(const std::vector<int64_t>& times) {
  std::vector<Event> events;
  for (const int64_t t : times) events.push_back({.t = t, .x = 1, .y = 2, .p = 1});
  return events;
}

/// A recording in memory that hands out at most `at_once` events per read.
class VectorSource final : public EventSource {
 public:
  VectorSource(std::vector<Event> events, SensorSize sensor, size_t at_once = 1000)
      : events_(std::move(events)), sensor_(sensor), at_once_(at_once) {}

  std::string_view format() const override { return "memory"; }
  std::optional<SensorSize> sensor() const override { return sensor_; }
  Result<size_t> read(std::span<Event> out) override {
    const size_t n = std::min({out.size(), at_once_, events_.size() - position_});
    std::copy_n(events_.begin() + static_cast<std::ptrdiff_t>(position_), n, out.begin());
    position_ += n;
    report_.events += n;
    return n;
  }
  const ReadReport& report() const override { return report_; }
  uint64_t bytes_read() const override { return position_ * sizeof(Event); }
  uint64_t bytes_total() const override { return events_.size() * sizeof(Event); }

 private:
  const std::vector<Event> events_;
  const SensorSize sensor_;
  const size_t at_once_;
  size_t position_ = 0;
  ReadReport report_;
};

}  // namespace scarf::tools
