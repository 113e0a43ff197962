#include "bench/endless.h"

#include <algorithm>
#include <cmath>

#include "scarf/simulate/simulate.h"

namespace scarf::bench {
namespace {

constexpr size_t kLeast = 100'000;

}  // namespace

EndlessStream::EndlessStream(std::vector<Event> events, double slowest_hz) : events_(std::move(events)) {
  const auto [oldest, newest] = std::minmax_element(events_.begin(), events_.end(),
                                                    [](const Event& a, const Event& b) { return a.t < b.t; });
  period_ = newest->t - oldest->t + 1;
  const size_t once = events_.size();
  const size_t least = std::max(kLeast, events_per_query(slowest_hz));
  while (events_.size() < least) {
    const size_t end = events_.size();
    for (size_t i = end - once; i < end; ++i) {
      events_.push_back(events_[i]);
      events_.back().t += period_;
    }
  }
  period_ *= static_cast<int64_t>(events_.size() / once);
}

std::span<const Event> EndlessStream::next(size_t n) {
  if (position_ + n > events_.size()) {
    for (Event& e : events_) e.t += period_;
    position_ = 0;
  }
  position_ += n;
  return std::span<const Event>(events_).subspan(position_ - n, n);
}

double EndlessStream::events_per_second() const {
  return static_cast<double>(events_.size()) * 1e6 / static_cast<double>(period_);
}

size_t EndlessStream::events_per_query(double hz) const {
  return static_cast<size_t>(std::max(1.0, std::round(events_per_second() / hz)));
}

Result<std::vector<Event>> shaken_scene(SensorSize sensor, size_t count, double events_per_second) {
  // The camera rests in the first half of the time.
  const auto simulation = make_simulation({.sensor = sensor, .scene = "shake", .duration_s = 4});
  if (!simulation) return simulation.error();
  const int64_t start = (*simulation)->duration() / 2;
  std::vector<Event> events;
  events.reserve(count);
  while (events.size() < count && !(*simulation)->finished()) {
    for (const Event& e : (*simulation)->next()) {
      if (e.t >= start) events.push_back(e);
    }
  }
  if (events.empty()) return events;
  const double simulated_us = static_cast<double>(events.back().t - start + 1);
  const double slower = static_cast<double>(events.size()) * 1e6 / events_per_second / simulated_us;
  for (Event& e : events) e.t = std::llround(static_cast<double>(e.t - start) * slower);
  return events;
}

}  // namespace scarf::bench
