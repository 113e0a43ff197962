#include "core/tables.h"

#include <algorithm>
#include <cmath>

namespace scarf {
namespace {

Levels reserved(int64_t entries) {
  Levels levels;
  levels.u8.reserve(entries);
  levels.f32.reserve(entries);
  return levels;
}

// nearbyint rounds half to even in the default rounding mode.
void append_value(Levels& levels, double value) {
  levels.u8.push_back(static_cast<uint8_t>(std::nearbyint(255.0 * value)));
  levels.f32.push_back(static_cast<float>(value));
}

// Brightness 0 .. 255 by age: 255 at age 0, and from one age to the next by `weaken`.
template <class Weaken>
Levels ordinal_table(Weaken weaken) {
  Levels levels = reserved(kNeverFiredAge + 1);
  double brightness = 255;
  for (int32_t age = 0; age <= kOldest; ++age) {
    levels.u8.push_back(static_cast<uint8_t>(std::nearbyint(brightness)));
    levels.f32.push_back(static_cast<float>(brightness / 255));
    brightness = weaken(brightness);
  }
  append_value(levels, 0);  // kNeverFiredAge
  return levels;
}

}  // namespace

Levels eros_table(int32_t kernel, double decay) {
  const double factor = std::pow(decay, 1.0 / kernel);
  return ordinal_table([factor](double brightness) { return brightness * factor; });
}

Levels tos_table(int32_t kernel, double decay) {
  const double threshold = 255 - kernel * decay;
  return ordinal_table(
      [threshold](double brightness) { return brightness < threshold ? 0.0 : brightness - 1; });
}

int64_t exponential_step(int64_t tau) {
  return std::max<int64_t>(1, tau / 8192);
}

Levels exponential_table(int64_t tau) {
  const int64_t step = exponential_step(tau);
  Levels levels = reserved(8 * tau / step + 2);
  for (int64_t age = 0; age < 8 * tau; age += step) {
    append_value(levels, std::exp(-static_cast<double>(age) / static_cast<double>(tau)));
  }
  append_value(levels, 0);
  return levels;
}

Levels linear_table(int64_t tau) {
  Levels levels = reserved(tau + 1);
  for (int64_t age = 0; age <= tau; ++age) {
    append_value(levels, 1.0 - static_cast<double>(age) / static_cast<double>(tau));
  }
  return levels;
}

Levels chain_table(int64_t pixels, bool linear) {
  Levels levels = reserved(pixels + 1);
  for (int64_t rank = 0; rank <= pixels; ++rank) {
    const double weight = 1.0 - static_cast<double>(rank) / static_cast<double>(pixels);
    append_value(levels, linear ? weight : std::pow(weight, 10.0));
  }
  return levels;
}

}  // namespace scarf
