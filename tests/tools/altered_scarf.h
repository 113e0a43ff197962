// A SCARF implementation with one fault that a comparison must find.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "scarf/core/patch_state.h"

namespace scarf::tools {

/// Hands out what another Scarf does, each answer after an alteration.
class AlteredScarf final : public Scarf {
 public:
  explicit AlteredScarf(std::unique_ptr<Scarf> scarf) : scarf_(std::move(scarf)) {}

  std::function<void(Snapshot&)> alter_snapshot = [](Snapshot&) {};
  std::function<void(Image<int32_t>&)> alter_counts = [](Image<int32_t>&) {};
  std::function<void(Image<uint8_t>&)> alter_u8 = [](Image<uint8_t>&) {};
  std::function<void(Image<float>&)> alter_float = [](Image<float>&) {};
  std::function<void(std::vector<Event>&)> alter_events = [](std::vector<Event>&) {};
  std::function<Result<PushReport>(Result<PushReport>)> alter_report = [](Result<PushReport> r) { return r; };

  const Geometry& geometry() const override { return scarf_->geometry(); }
  Result<PushReport> push(std::span<const Event> events) override {
    return alter_report(scarf_->push(events));
  }
  Result<void> reset() override { return scarf_->reset(); }
  Pending<Image<int32_t>> count_image(PolarityMode mode) override {
    return altered(scarf_->count_image(mode), alter_counts);
  }
  Pending<Image<uint8_t>> u8_planes(PolarityMode mode) override {
    return altered(scarf_->u8_planes(mode), alter_u8);
  }
  Pending<Image<float>> float_planes(PolarityMode mode) override {
    return altered(scarf_->float_planes(mode), alter_float);
  }
  Pending<std::vector<Event>> active_events(EventOrder order) override {
    return altered(scarf_->active_events(order), alter_events);
  }
  Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) override {
    return scarf_->patch_events(patch, active_only);
  }
  Pending<Snapshot> snapshot() override { return altered(scarf_->snapshot(), alter_snapshot); }

 private:
  template <class T>
  static Pending<T> altered(Pending<T> pending, const std::function<void(T&)>& alter) {
    Result<T> result = pending.wait();
    if (result) alter(*result);
    return result;
  }

  std::unique_ptr<Scarf> scarf_;
};

}  // namespace scarf::tools
