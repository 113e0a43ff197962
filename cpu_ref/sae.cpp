// Surface of active events (SAE, time surface), as defined: the last time of each pixel and polarity, shown
// with a decay. Source: Lagorce et al., "HOTS: A Hierarchy of Event-Based Time-Surfaces", 2017.
#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

class Sae final : public ValueSurface {
 public:
  Sae(const SaeParameters& parameters, SensorSize sensor)
      : ValueSurface(sensor),
        decay_(parameters.decay),
        tau_(parameters.tau),
        step_(std::max<uint64_t>(1, tau_ / 8192)),
        last_(2 * pixels(), kNeverFired) {}

 private:
  void update(const Event& e) override {
    newest_ = e.t;
    last_[e.p * pixels() + pixel(e)] = e.t;
  }

  void clear() override {
    newest_ = kNeverFired;
    last_.assign(2 * pixels(), kNeverFired);
  }

  std::vector<double> values(std::optional<int64_t> now) override {
    std::vector<double> values;
    for (size_t i = 0; i < pixels(); ++i) {
      const int64_t last = std::max(last_[i], last_[pixels() + i]);
      values.push_back(last == kNeverFired ? 0 : decayed(age_of(last, now.value_or(newest_))));
    }
    return values;
  }

  double decayed(uint64_t age) const {
    const auto tau = static_cast<double>(tau_);
    if (decay_ == SaeParameters::Decay::linear) return std::max(0.0, 1.0 - static_cast<double>(age) / tau);
    if (age >= 8 * tau_) return 0;
    // Ages in steps, so that a table of a bounded size holds all values.
    return std::exp(-static_cast<double>(age / step_ * step_) / tau);
  }

  Image<int64_t> raw_picture() override { return raw(last_); }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    append_little_endian(bytes, newest_);
    append_all(bytes, last_);
    return bytes;
  }

  const SaeParameters::Decay decay_;
  const uint64_t tau_;   // microseconds
  const uint64_t step_;  // microseconds
  int64_t newest_ = kNeverFired;
  std::vector<int64_t> last_;  // the plane of OFF, then the plane of ON
};

}  // namespace

Reference make_reference(const SaeParameters& parameters, SensorSize sensor) {
  return std::make_unique<Sae>(parameters, sensor);
}

}  // namespace scarf
