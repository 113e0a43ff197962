// The one rule by which all readers round what is finer than a microsecond: to the nearest, halves up.
#pragma once

#include <cmath>
#include <cstdint>

namespace scarf {

/// value / divisor; a half is rounded up, towards later times. `divisor` is from 1 to 2^62.
constexpr int64_t rounded_quotient(int64_t value, int64_t divisor) {
  const int64_t rest = value % divisor;
  const int64_t below = value / divisor - (rest < 0 ? 1 : 0);
  const int64_t above_it = rest < 0 ? rest + divisor : rest;
  return below + (above_it >= divisor - above_it ? 1 : 0);
}

/// The nearest whole number. Not floor(value + 0.5), whose sum is rounded itself.
inline double rounded(double value) {
  const double below = std::floor(value);
  return value - below >= 0.5 ? below + 1 : below;
}

/// Nanoseconds since 1970 of 64 bits, as ROS has them, in microseconds.
constexpr int64_t microseconds_of(uint64_t nanoseconds) {
  return static_cast<int64_t>(nanoseconds / 1000 + (nanoseconds % 1000 >= 500 ? 1 : 0));
}

}  // namespace scarf
