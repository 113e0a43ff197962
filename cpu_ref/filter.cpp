// The noise filters, as defined in scarf/core/filter.h: one event after the other.
#include "scarf/core/filter.h"

#include <algorithm>
#include <optional>

#include "core/batch_check.h"
#include "core/sensor_check.h"

namespace scarf {
namespace {

// What all filters share; `passes` of a filter decides about the events inside the sensor, in their order.
class ReferenceFilter : public EventFilter {
 public:
  explicit ReferenceFilter(SensorSize sensor) : sensor_(sensor) {}

  SensorSize sensor() const override { return sensor_; }
  const FilterReport& report() const override { return report_; }

  Result<size_t> filter(std::span<const Event> events, std::vector<Event>& passing) override {
    return as_result([&]() -> Result<size_t> {
      const auto batch = check_batch(events, sensor_, t_first_);
      if (!batch) return batch.error();
      const size_t before = passing.size();
      // Room for all of them first, so that nothing fails half-way.
      passing.resize(before + events.size());
      passing.resize(before);
      t_first_ = batch->t_first;
      for (const Event& e : events) {
        if (!sensor_.contains(e)) {
          ++report_.outside;
          passing.push_back(e);
        } else if (passes(e)) {
          ++report_.passed;
          passing.push_back(e);
        } else {
          ++report_.rejected;
        }
      }
      return passing.size() - before;
    });
  }

  Result<void> reset() override {
    t_first_.reset();
    report_ = {};
    forget();
    return {};
  }

 protected:
  // Whether the event passes; remembers it.
  virtual bool passes(const Event& e) = 0;
  virtual void forget() = 0;

  size_t pixels() const { return static_cast<size_t>(sensor_.width) * sensor_.height; }
  size_t pixel(int32_t x, int32_t y) const { return static_cast<size_t>(y) * sensor_.width + x; }

 private:
  const SensorSize sensor_;
  std::optional<int64_t> t_first_;
  FilterReport report_;
};

class ReferenceSupport final : public ReferenceFilter {
 public:
  ReferenceSupport(const SupportFilter& parameters, SensorSize sensor)
      : ReferenceFilter(sensor), parameters_(parameters), last_(2 * pixels()) {}

 private:
  bool passes(const Event& e) override {
    const bool supported = has_support(e);
    last(e.x, e.y, e.p) = e.t;
    return supported;
  }

  bool has_support(const Event& e) {
    const int32_t r = parameters_.range;
    for (int32_t y = std::max(0, e.y - r); y <= std::min(sensor().height - 1, e.y + r); ++y) {
      for (int32_t x = std::max(0, e.x - r); x <= std::min(sensor().width - 1, e.x + r); ++x) {
        const std::optional<int64_t> t = last(x, y, e.p);
        if (t && e.t - *t <= parameters_.period) return true;
      }
    }
    return false;
  }

  std::optional<int64_t>& last(int32_t x, int32_t y, uint8_t p) { return last_[p * pixels() + pixel(x, y)]; }
  void forget() override { last_.assign(last_.size(), std::nullopt); }

  const SupportFilter parameters_;
  std::vector<std::optional<int64_t>> last_;  // per polarity and pixel: time of the last event to arrive
};

class ReferenceRefractory final : public ReferenceFilter {
 public:
  ReferenceRefractory(const RefractoryFilter& parameters, SensorSize sensor)
      : ReferenceFilter(sensor), parameters_(parameters), last_(pixels()) {}

 private:
  bool passes(const Event& e) override {
    std::optional<int64_t>& last = last_[pixel(e.x, e.y)];
    if (last && *last <= e.t && e.t - *last < parameters_.period) return false;
    last = e.t;
    return true;
  }

  void forget() override { last_.assign(last_.size(), std::nullopt); }

  const RefractoryFilter parameters_;
  std::vector<std::optional<int64_t>> last_;  // per pixel: time of the last event that passed
};

}  // namespace

Result<std::unique_ptr<EventFilter>> make_reference_filter(const FilterParameters& parameters,
                                                           SensorSize sensor) {
  return as_result([&]() -> Result<std::unique_ptr<EventFilter>> {
    if (auto r = checked_filter(parameters); !r) return r.error();
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (const auto* support = std::get_if<SupportFilter>(&parameters)) {
      return std::unique_ptr<EventFilter>(std::make_unique<ReferenceSupport>(*support, sensor));
    }
    const auto& refractory = std::get<RefractoryFilter>(parameters);
    return std::unique_ptr<EventFilter>(std::make_unique<ReferenceRefractory>(refractory, sensor));
  });
}

}  // namespace scarf
