// Time window, as defined: the pixels that fired within the last w microseconds, or how often they did.
#include <deque>

#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

class TimeWindow final : public ValueSurface {
 public:
  TimeWindow(const TimeWindowParameters& parameters, SensorSize sensor)
      : ValueSurface(sensor), window_(parameters.window), last_(pixels(), kNeverFired) {}

 private:
  void update(const Event& e) override {
    newest_ = e.t;
    last_[pixel(e)] = e.t;
  }

  void clear() override {
    newest_ = kNeverFired;
    last_.assign(pixels(), kNeverFired);
  }

  std::vector<double> values(std::optional<int64_t> now) override {
    std::vector<double> values;
    for (const int64_t last : last_) {
      const bool recent = last != kNeverFired && age_of(last, now.value_or(newest_)) < window_;
      values.push_back(recent ? 1 : 0);
    }
    return values;
  }

  Image<int64_t> raw_picture() override { return raw(last_); }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    append_little_endian(bytes, newest_);
    append_all(bytes, last_);
    return bytes;
  }

  const uint64_t window_;  // microseconds
  int64_t newest_ = kNeverFired;
  std::vector<int64_t> last_;
};

// With `counts`.
class CountWindow final : public Surface {
 public:
  CountWindow(const TimeWindowParameters& parameters, SensorSize sensor)
      : Surface(sensor), window_(parameters.window), accumulation_(parameters.accumulation) {}

 private:
  void update(const Event& e) override {
    t_max_ = std::max(t_max_, e.t);
    received_.push_back(e);
    // Times may step back, so there can be more such events further behind; kept_events leaves them out.
    while (!listed(received_.front())) received_.pop_front();
  }

  void clear() override {
    t_max_ = kNeverFired;
    received_.clear();
  }

  bool listed(const Event& e) const { return age_of(e.t, t_max_) < window_; }

  std::vector<int64_t> counts(std::optional<int64_t> now) const {
    const int64_t t = std::max(t_max_, now.value_or(t_max_));
    std::vector<int64_t> counts(pixels(), 0);
    for (const Event& e : received_) counts[pixel(e)] += age_of(e.t, t) < window_ ? 1 : 0;
    return counts;
  }

  // Brightness of counts: as make_levels has it, without an end.
  Image<uint8_t> u8_picture(std::optional<int64_t> now) override {
    return picture<uint8_t>(counts(now), [c = accumulation_](int64_t count) {
      if (count == 0) return uint8_t{0};  // also where 255 * c is infinite
      return static_cast<uint8_t>(std::min(255.0, std::nearbyint((255.0 * c) * static_cast<double>(count))));
    });
  }
  Image<float> float_picture(std::optional<int64_t> now) override {
    return picture<float>(counts(now), [c = accumulation_](int64_t count) {
      return static_cast<float>(c * static_cast<double>(count));
    });
  }
  Image<int64_t> raw_picture() override { return raw(counts({})); }

  Result<std::vector<Event>> kept_events() const override {
    std::vector<Event> events;
    for (const Event& e : received_) {
      if (listed(e)) events.push_back(e);
    }
    return events;
  }

  std::vector<uint8_t> state_bytes() const override {
    const std::vector<Event> events = *kept_events();
    std::vector<uint8_t> bytes;
    append_little_endian(bytes, t_max_);
    append_list(bytes, events);
    return bytes;
  }

  const uint64_t window_;  // microseconds
  const double accumulation_;
  int64_t t_max_ = kNeverFired;  // the largest time since the last reset
  std::deque<Event> received_;   // in order of arrival; the first one is listed
};

}  // namespace

Reference make_reference(const TimeWindowParameters& parameters, SensorSize sensor) {
  if (parameters.counts) return std::make_unique<CountWindow>(parameters, sensor);
  return std::make_unique<TimeWindow>(parameters, sensor);
}

}  // namespace scarf
