// A representation behind noise filters.
#include <mutex>
#include <type_traits>
#include <utility>

#include "scarf/reference/reference.h"

namespace scarf {
namespace {

class Filtered final : public Representation {
 public:
  Filtered(std::unique_ptr<Representation> representation, FilterChain filters)
      : representation_(std::move(representation)), filters_(std::move(filters)) {}

  SensorSize sensor() const override { return representation_->sensor(); }

  Result<PushReport> push(std::span<const Event> events) override {
    return complete([&]() -> Result<PushReport> {
      const auto passing = filters_.filter(events);
      if (!passing) return passing.error();
      incomplete_ = true;  // unless the representation takes what the filters have let pass
      const auto report = representation_->push(*passing);
      if (!report) return report.error();
      incomplete_ = false;
      return PushReport{events.size(), report->outside};  // filters let events outside the sensor pass
    });
  }

  Result<void> reset() override {
    std::lock_guard lock(mutex_);
    incomplete_ = true;
    if (auto r = filters_.reset(); !r) return r;
    if (auto r = representation_->reset(); !r) return r;
    incomplete_ = false;
    return {};
  }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) override {
    return complete([&] { return representation_->u8_image(now); });
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) override {
    return complete([&] { return representation_->float_image(now); });
  }
  Pending<Image<int64_t>> raw_image() override {
    return complete([&] { return representation_->raw_image(); });
  }
  Pending<std::vector<Event>> events() override {
    return complete([&] { return representation_->events(); });
  }
  Pending<std::vector<uint8_t>> state() override {
    return complete([&] { return representation_->state(); });
  }
  Pending<std::vector<FilterReport>> filter_reports() override {
    return complete([&]() -> Pending<std::vector<FilterReport>> { return filters_.reports(); });
  }

 private:
  template <class Call>
  std::invoke_result_t<Call&> complete(Call call) {
    return as_result([&]() -> std::invoke_result_t<Call&> {
      std::lock_guard lock(mutex_);
      if (incomplete_ || !filters_.complete()) {
        return Error{ErrorCode::refused_batch,
                     "the representation is incomplete, since it or one of its filters did not take a batch; "
                     "reset it"};
      }
      return call();
    });
  }

  std::mutex mutex_;
  std::unique_ptr<Representation> representation_;
  FilterChain filters_;
  bool incomplete_ = false;  // until reset
};

}  // namespace

Result<std::unique_ptr<Representation>> behind_filters(std::unique_ptr<Representation> representation,
                                                       std::span<const FilterParameters> filters) {
  return as_result([&]() -> Result<std::unique_ptr<Representation>> {
    if (representation == nullptr)
      return Error{ErrorCode::illegal_parameter, "the representation is null; make one first"};
    if (filters.empty()) return std::move(representation);
    std::vector<std::unique_ptr<EventFilter>> made;
    for (const FilterParameters& parameters : filters) {
      auto filter = make_reference_filter(parameters, representation->sensor());
      if (!filter) return filter.error();
      made.push_back(std::move(*filter));
    }
    return std::unique_ptr<Representation>(
        std::make_unique<Filtered>(std::move(representation), FilterChain(std::move(made))));
  });
}

}  // namespace scarf
