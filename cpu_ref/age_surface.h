// The state that EROS and TOS share: the age of a pixel is how many events fell into its window since its own
// last event.
#pragma once

#include "core/tables.h"
#include "cpu_ref/surface.h"

namespace scarf {

class AgeSurface final : public Surface {
 public:
  /// `kernel` is odd; `brightness` is by age.
  AgeSurface(SensorSize sensor, int32_t kernel, Levels brightness)
      : Surface(sensor),
        reach_(kernel / 2),
        brightness_(std::move(brightness)),
        ages_(pixels(), kNeverFiredAge) {}

 private:
  void update(const Event& e) override {
    for (int32_t y = std::max(0, e.y - reach_); y <= std::min(sensor().height - 1, e.y + reach_); ++y) {
      for (int32_t x = std::max(0, e.x - reach_); x <= std::min(sensor().width - 1, e.x + reach_); ++x) {
        uint16_t& age = ages_[static_cast<size_t>(y) * sensor().width + x];
        if (age < kOldest) ++age;
      }
    }
    ages_[pixel(e)] = 0;
  }

  void clear() override { ages_.assign(pixels(), kNeverFiredAge); }

  Image<uint8_t> u8_picture(std::optional<int64_t>) override {
    return picture<uint8_t>(ages_, [this](uint16_t age) { return brightness_.u8[age]; });
  }
  Image<float> float_picture(std::optional<int64_t>) override {
    return picture<float>(ages_, [this](uint16_t age) { return brightness_.f32[age]; });
  }
  Image<int64_t> raw_picture() override { return raw(ages_); }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    append_all(bytes, ages_);
    return bytes;
  }

  const int32_t reach_;
  const Levels brightness_;
  std::vector<uint16_t> ages_;
};

}  // namespace scarf
