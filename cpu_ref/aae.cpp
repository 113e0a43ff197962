// AAE (adaptive accumulation of events), as defined: each block shows as many of its newest events as its
// activity takes to come back to where it converges. Source: Niu et al., "ESVO2: Direct Visual-Inertial
// Odometry With Stereo Event Cameras", 2025.
#include "cpu_ref/aae.h"

#include <deque>

#include "core/block_grid.h"
#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

constexpr size_t kLongestQueue = 100'000;
constexpr double kBrightness = 0.4;  // of one drawn event
constexpr double kClose = 1e-9;

constexpr double kConvergence = 0.02;  // relative

constexpr double kEsvo2Convergence = 0.95;
constexpr size_t kEsvo2Check = 10;  // events from one check to the next

double seconds(int64_t microseconds) {
  return static_cast<double>(microseconds) * 1e-6;
}

class Aae final : public ValueSurface {
 public:
  Aae(const AaeParameters& parameters, SensorSize sensor)
      : ValueSurface(sensor),
        parameters_(parameters),
        grid_(block_grid(parameters, sensor)),
        queues_(grid_.blocks()),
        passed_(grid_.blocks()) {}

 private:
  void update(const Event& e) override {
    std::deque<Event>& queue = queues_[grid_.block_of(e)];
    queue.push_back(e);
    if (queue.size() > kLongestQueue) queue.pop_front();
  }

  void clear() override {
    for (auto& queue : queues_) queue.clear();
  }

  // How often each pixel is drawn; cut() is to follow.
  std::vector<int64_t> draws() {
    std::vector<int64_t> draws(pixels(), 0);
    for (size_t i = 0; i < queues_.size(); ++i) {
      const std::vector<Event> events(queues_[i].begin(), queues_[i].end());
      const BlockWalk walk = parameters_.esvo2 ? walk_block_esvo2(events) : walk_block(events);
      for (const Event& e : std::span(events).last(walk.drawn)) draws[pixel(e)] += 1;
      passed_[i] = walk.passed;
    }
    return draws;
  }

  // The queues keep what passed, once the picture is there.
  template <class T>
  Image<T> cut(Image<T> picture) {
    for (size_t i = 0; i < queues_.size() && !parameters_.keep; ++i) {
      auto& queue = queues_[i];
      queue.erase(queue.begin(), queue.end() - static_cast<std::ptrdiff_t>(passed_[i]));
    }
    return picture;
  }

  std::vector<double> values(std::optional<int64_t>) override {
    std::vector<double> values;
    for (const int64_t count : draws()) values.push_back(kBrightness * static_cast<double>(count));
    return values;
  }

  Image<uint8_t> u8_picture(std::optional<int64_t> now) override {
    return cut(ValueSurface::u8_picture(now));
  }
  Image<float> float_picture(std::optional<int64_t> now) override {
    return cut(ValueSurface::float_picture(now));
  }
  Image<int64_t> raw_picture() override { return cut(raw(draws())); }

  Result<std::vector<Event>> kept_events() const override {
    std::vector<Event> events;
    for (const auto& queue : queues_) events.insert(events.end(), queue.begin(), queue.end());
    return events;
  }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    append_little_endian(bytes, static_cast<uint32_t>(queues_.size()));
    for (const auto& queue : queues_) {
      append_little_endian(bytes, static_cast<uint32_t>(queue.size()));
      for (const Event& e : queue) append_event(bytes, e);
    }
    return bytes;
  }

  const AaeParameters parameters_;
  const BlockGrid grid_;
  std::vector<std::deque<Event>> queues_;  // by block in raster order; each oldest first
  std::vector<size_t> passed_;             // of each queue's newest events, those that stay
};

}  // namespace

BlockWalk walk_block(std::span<const Event> queue) {
  const size_t n = queue.size();
  double converged = 0;  // 0: never stop early
  if (n >= 2) {
    const double mean = seconds(queue[n - 1].t - queue[0].t) / static_cast<double>(n - 1);
    if (mean > 0) converged = 1 / std::sqrt(mean);
  }
  BlockWalk walk;
  double activity = 0;
  for (size_t v = n; v-- > 1;) {
    activity = activity / (1 + activity * seconds(queue[v].t - queue[v - 1].t)) + 1;
    walk.drawn += 1;
    if (converged > 0) {
      const double distance = std::abs(activity - converged) / converged;
      walk.close |= std::abs(distance - kConvergence) <= kClose;
      if (distance < kConvergence) break;
    }
    walk.passed += 1;
  }
  return walk;
}

BlockWalk walk_block_esvo2(std::span<const Event> queue) {
  const size_t n = queue.size();
  const auto next = [queue](double activity, size_t v, size_t previous) {
    return activity / (1 + activity * std::abs(seconds(queue[v].t - queue[previous].t))) + 1;
  };
  // The first event of a pass has none before it, and makes the activity 1.
  double converged = n > 0 ? 1 : 0;
  for (size_t v = 1; v < n; ++v) converged = next(converged, v, v - 1);

  BlockWalk walk;  // passed stays 0: the next query sees the events after this one
  double activity = 1;
  for (size_t v = n; v-- > 0;) {
    if (v + 1 < n) activity = next(activity, v, v + 1);
    walk.drawn += 1;
    if (walk.drawn % kEsvo2Check != 0 || walk.drawn == kEsvo2Check) continue;
    const double distance = std::abs(activity - converged);
    walk.close |= std::abs(distance - kEsvo2Convergence) <= kClose;
    if (distance < kEsvo2Convergence) break;
  }
  return walk;
}

Reference make_reference(const AaeParameters& parameters, SensorSize sensor) {
  return std::make_unique<Aae>(parameters, sensor);
}

}  // namespace scarf
