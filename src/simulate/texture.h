// A plane of random grey blotches, for surfaces.
#pragma once

#include <cstdint>
#include <vector>

namespace scarf::simulate {

/// A pattern of values in 0 .. 1 that repeats every kPeriod pixels in x and y.
class Texture {
 public:
  static constexpr int32_t kPeriod = 512;

  explicit Texture(uint64_t seed);
  /// The value at a point, linear between whole pixels; coordinates above -64 periods.
  double at(double x, double y) const;

 private:
  std::vector<float> values_;
};

}  // namespace scarf::simulate
