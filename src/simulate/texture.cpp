// Value noise in two octaves: random values on a lattice, smoothly interpolated.
#include "simulate/texture.h"

#include <algorithm>

#include "simulate/random.h"

namespace scarf::simulate {
namespace {

constexpr int32_t kMask = Texture::kPeriod - 1;
static_assert((Texture::kPeriod & kMask) == 0);

double smooth(double f) {
  return f * f * (3 - 2 * f);
}

// Adds `weight` times noise whose lattice has cells of `cell` pixels.
void add_octave(std::vector<float>& values, int32_t cell, double weight, Random& random) {
  const int32_t n = Texture::kPeriod / cell;
  std::vector<double> lattice(static_cast<size_t>(n) * n);
  for (double& v : lattice) v = random.uniform();
  for (int32_t y = 0; y < Texture::kPeriod; ++y) {
    const double fy = smooth(static_cast<double>(y % cell) / cell);
    const int32_t top = y / cell * n;
    const int32_t bottom = (y / cell + 1) % n * n;
    for (int32_t x = 0; x < Texture::kPeriod; ++x) {
      const double fx = smooth(static_cast<double>(x % cell) / cell);
      const int32_t left = x / cell;
      const int32_t right = (left + 1) % n;
      const double upper = lattice[top + left] + (lattice[top + right] - lattice[top + left]) * fx;
      const double lower = lattice[bottom + left] + (lattice[bottom + right] - lattice[bottom + left]) * fx;
      values[y * Texture::kPeriod + x] += static_cast<float>(weight * (upper + (lower - upper) * fy));
    }
  }
}

}  // namespace

Texture::Texture(uint64_t seed) : values_(static_cast<size_t>(kPeriod) * kPeriod) {
  Random random(seed, 0);
  add_octave(values_, 32, 0.5, random);
  add_octave(values_, 8, 0.5, random);
  // More contrast: sums of random numbers crowd in the middle.
  for (float& v : values_) v = std::clamp(0.5f + 2.0f * (v - 0.5f), 0.0f, 1.0f);
}

double Texture::at(double x, double y) const {
  // Whole periods make the coordinates positive, where truncation is the floor (which is a slow call).
  constexpr double kShift = 64.0 * kPeriod;
  x += kShift;
  y += kShift;
  const auto column = static_cast<int32_t>(x);
  const auto row = static_cast<int32_t>(y);
  const int32_t left = column & kMask;
  const int32_t right = (column + 1) & kMask;
  const float* upper = &values_[static_cast<size_t>(row & kMask) * kPeriod];
  const float* lower = &values_[static_cast<size_t>((row + 1) & kMask) * kPeriod];
  const double fx = x - column;
  const double a = upper[left] + (upper[right] - upper[left]) * fx;
  const double b = lower[left] + (lower[right] - lower[left]) * fx;
  return a + (b - a) * (y - row);
}

}  // namespace scarf::simulate
