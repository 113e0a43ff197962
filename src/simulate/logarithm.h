// A natural logarithm from basic arithmetic, since the standard library's differs in the last bit between
// platforms.
#pragma once

#include <cmath>

namespace scarf::simulate {

/// ln(x) for x > 0.
inline double natural_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // exact, in [0.5, 1)
  if (mantissa < 0.70710678118654752) {
    mantissa *= 2;
    --exponent;
  }
  // ln(m) = 2 artanh(z); |z| < 0.172, so that twelve terms of the series reach double precision.
  const double z = (mantissa - 1) / (mantissa + 1);
  double series = 0;
  for (int n = 23; n >= 1; n -= 2) series = series * (z * z) + 1.0 / n;
  return 2 * z * series + exponent * 0.69314718055994531;
}

}  // namespace scarf::simulate
