// The brightness tables of dense images.
#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "scarf/core/image.h"

namespace scarf {

Result<Levels> make_levels(double accumulation, int32_t capacity) {
  return as_result([&]() -> Result<Levels> {
    if (!std::isfinite(accumulation) || accumulation <= 0) {
      return Error{ErrorCode::illegal_parameter,
                   text("accumulation is ", accumulation, ", legal is a finite number > 0")};
    }
    Levels levels;
    levels.u8.reserve(capacity + 1);
    levels.f32.reserve(capacity + 1);
    // No event is black for every accumulation, also where 255 * c is infinite and times 0 not a number.
    levels.u8.push_back(0);
    levels.f32.push_back(0);
    for (int32_t count = 1; count <= capacity; ++count) {
      // nearbyint rounds half to even in the default rounding mode.
      levels.u8.push_back(
          static_cast<uint8_t>(std::min(255.0, std::nearbyint((255.0 * accumulation) * count))));
      levels.f32.push_back(static_cast<float>(accumulation * static_cast<double>(count)));
    }
    return levels;
  });
}

}  // namespace scarf
