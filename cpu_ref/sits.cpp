// SITS (speed invariant time surface), as defined: an event makes its pixel the newest of its window, and
// takes 1 from the pixels that were as new as it was or newer. Source: Manderscheid et al., "Speed Invariant
// Time Surface for Learning to Detect Corner Points with Event-Based Cameras", CVPR 2019.
#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

using Rule = SitsParameters::Rule;

class Sits final : public Surface {
 public:
  Sits(const SitsParameters& parameters, SensorSize sensor)
      : Surface(sensor),
        rule_(parameters.rule),
        reach_(parameters.kernel / 2),
        white_(parameters.kernel * parameters.kernel),
        values_(pixels(), 0) {}

 private:
  void update(const Event& e) override {
    int32_t& centre = values_[pixel(e)];
    const int32_t before = centre;
    // Column by column, which matters to Rule::event_driven alone.
    for (int32_t x = std::max(0, e.x - reach_); x <= std::min(sensor().width - 1, e.x + reach_); ++x) {
      for (int32_t y = std::max(0, e.y - reach_); y <= std::min(sensor().height - 1, e.y + reach_); ++y) {
        int32_t& value = values_[static_cast<size_t>(y) * sensor().width + x];
        if (counts(value, before, centre)) --value;
      }
    }
    centre = white_;
  }

  bool counts(int32_t value, int32_t before, int32_t centre) const {
    if (rule_ == Rule::greater) return value > before;
    if (rule_ == Rule::event_driven)
      return value >= centre;  // once the centre itself was visited: before - 1
    return value >= before;
  }

  void clear() override { values_.assign(pixels(), 0); }

  Image<uint8_t> u8_picture(std::optional<int64_t>) override {
    return picture<uint8_t>(values_, [this](int32_t value) {
      if (rule_ == Rule::event_driven) return static_cast<uint8_t>(std::clamp(value, 0, 255));
      return static_cast<uint8_t>(std::nearbyint(255.0 * std::max(0, value) / white_));
    });
  }
  Image<float> float_picture(std::optional<int64_t>) override {
    return picture<float>(values_, [this](int32_t value) {
      return static_cast<float>(static_cast<double>(std::max(0, value)) / white_);
    });
  }
  Image<int64_t> raw_picture() override { return raw(values_); }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    append_all(bytes, values_);
    return bytes;
  }

  const Rule rule_;
  const int32_t reach_;
  const int32_t white_;  // k * k
  std::vector<int32_t> values_;
};

}  // namespace

Reference make_reference(const SitsParameters& parameters, SensorSize sensor) {
  return std::make_unique<Sits>(parameters, sensor);
}

}  // namespace scarf
