// Values of the encodings that need logarithms and exponentials: made here once, so that no implementation
// does floating-point arithmetic of its own on them.
#pragma once

#include <cstdint>
#include <vector>

namespace scarf {

/// Weights are integers, in units of 2^-24: sums of them do not depend on the order, and each of 0 to 1 is a
/// float as it is.
inline constexpr int32_t kWeightBits = 24;
inline constexpr int64_t kWeightOne = int64_t{1} << kWeightBits;

inline constexpr int64_t kToreOldest = 5'000'000;  ///< microseconds; older events look as if this old
inline constexpr int64_t kToreNewest = 150;        ///< microseconds; up to this age the value is 0

/// TORE: max(0, log(d + 1) - log(151)), in double and then rounded to float, of an age d >= 0 in
/// microseconds, clipped to kToreOldest.
float tore_value(uint64_t age);
/// tore_value of 0 .. kToreOldest.
std::vector<float> tore_table();

/// exp(-age / tau), rounded to a multiple of 2^-24, half to even.
int64_t decay_weight(uint64_t age, int64_t tau);

}  // namespace scarf
