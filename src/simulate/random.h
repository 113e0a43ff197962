// Random numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <cstdint>

#include "simulate/logarithm.h"

namespace scarf::simulate {

/// splitmix64 (Steele, Lea, Flood: "Fast Splittable Pseudorandom Number Generators", 2014).
class Random {
 public:
  /// Streams of one seed are independent of each other, so that more noise does not change the thresholds.
  Random(uint64_t seed, uint64_t stream) : state_(seed) { state_ = bits() ^ (stream * 0xd1342543de82ef95); }

  uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// Uniform in (0, 1].
  double uniform() { return static_cast<double>((bits() >> 11) + 1) * 0x1p-53; }
  /// Uniform in 0 .. n - 1.
  int32_t below(int32_t n) { return static_cast<int32_t>((bits() >> 32) * static_cast<uint64_t>(n) >> 32); }
  /// Mean 0, standard deviation 1, within -6 .. 6.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }
  /// Time to the next of events that come independently at a rate.
  double interval(double rate) { return -natural_log(uniform()) / rate; }

 private:
  uint64_t state_;
};

}  // namespace scarf::simulate
