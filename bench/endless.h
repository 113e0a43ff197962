// A recording that is played again and again, with times that go on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf::bench {

class EndlessStream {
 public:
  /// At least one event. They are repeated until there are enough to measure with: those between two queries
  /// at `slowest_hz`, and 100,000.
  EndlessStream(std::vector<Event> events, double slowest_hz);

  /// The next n events, 1 to size(), in one piece. Where they would run over the end of the recording, they
  /// are its first n, later by its length. Valid until the next call.
  std::span<const Event> next(size_t n);

  size_t size() const { return events_.size(); }
  /// Of recorded time.
  double events_per_second() const;
  /// Events between two of `hz` queries per second of recorded time, at least 1.
  size_t events_per_query(double hz) const;

 private:
  std::vector<Event> events_;
  int64_t period_ = 0;  // microseconds from the first event of one round to that of the next
  size_t position_ = 0;
};

/// `count` events, or a little more, of a textured scene that a shaking camera sees, in a time that makes
/// events_per_second of them. Errors: those of make_simulation.
Result<std::vector<Event>> shaken_scene(SensorSize sensor, size_t count, double events_per_second);

}  // namespace scarf::bench
