// Pictures, and the tables that turn counts into brightness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

/// Planes of height x width pixels, row-major, origin top-left.
template <class T>
struct Image {
  int32_t width = 0;
  int32_t height = 0;
  int32_t planes = 1;
  std::vector<T> pixels;  ///< planes * height * width values

  Image() = default;
  Image(int32_t w, int32_t h, int32_t n = 1)
      : width(w), height(h), planes(n), pixels(static_cast<size_t>(w) * h * n) {}

  const T& at(int32_t x, int32_t y, int32_t plane = 0) const {
    return pixels[(static_cast<size_t>(plane) * height + y) * width + x];
  }
  friend bool operator==(const Image&, const Image&) = default;
};

/// What an image distinguishes.
enum class PolarityMode {
  merged,      ///< one plane, both polarities counted alike
  separate,    ///< two planes: plane 0 = OFF, plane 1 = ON
  difference,  ///< one plane of ON minus OFF; counts only, since brightness is not negative
};

/// Brightness of 0..N stored events in one pixel, from one table that every implementation indexes, so that
/// no implementation does floating-point arithmetic on pixels.
struct Levels {
  std::vector<uint8_t> u8;  ///< min(255, rint((255.0*c)*count)), half to even
  std::vector<float> f32;   ///< (float)(c*(double)count), not clipped
};

/// The N + 1 levels of accumulation c. Errors: illegal_parameter unless c is finite and > 0.
Result<Levels> make_levels(double accumulation, int32_t capacity);

}  // namespace scarf
