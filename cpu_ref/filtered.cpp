// A representation behind noise filters.
#include <mutex>
#include <utility>

#include "scarf/reference.h"

namespace scarf {
namespace {

class Filtered final : public Representation {
 public:
  Filtered(std::unique_ptr<Representation> representation, FilterChain filters)
      : representation_(std::move(representation)), filters_(std::move(filters)) {}

  SensorSize sensor() const override { return representation_->sensor(); }

  Result<PushReport> push(std::span<const Event> events) override {
    std::lock_guard lock(mutex_);
    const auto passing = filters_.filter(events);
    if (!passing) return passing.error();
    const auto report = representation_->push(*passing);
    if (!report) return report.error();
    return PushReport{events.size(), report->outside};  // filters let events outside the sensor pass
  }

  Result<void> reset() override {
    std::lock_guard lock(mutex_);
    if (auto r = filters_.reset(); !r) return r;
    return representation_->reset();
  }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) override {
    return representation_->u8_image(now);
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) override {
    return representation_->float_image(now);
  }
  Pending<Image<int64_t>> raw_image() override { return representation_->raw_image(); }
  Pending<std::vector<Event>> events() override { return representation_->events(); }
  Pending<std::vector<uint8_t>> state() override { return representation_->state(); }
  Pending<std::vector<FilterReport>> filter_reports() override {
    std::lock_guard lock(mutex_);
    return filters_.reports();
  }

 private:
  std::mutex mutex_;  // of the filters
  std::unique_ptr<Representation> representation_;
  FilterChain filters_;
};

}  // namespace

Result<std::unique_ptr<Representation>> behind_filters(std::unique_ptr<Representation> representation,
                                                       std::span<const FilterParameters> filters) {
  if (filters.empty()) return representation;
  std::vector<std::unique_ptr<EventFilter>> made;
  for (const FilterParameters& parameters : filters) {
    auto filter = make_reference_filter(parameters, representation->sensor());
    if (!filter) return filter.error();
    made.push_back(std::move(*filter));
  }
  return std::unique_ptr<Representation>(
      std::make_unique<Filtered>(std::move(representation), FilterChain(std::move(made))));
}

}  // namespace scarf
