// Colour as grey.
#pragma once

#include <cstdint>

namespace scarf {

/// Luma of ITU-R BT.601, in whole numbers, rounded half up; for values of up to 16 bits.
constexpr uint32_t luma(uint32_t red, uint32_t green, uint32_t blue) {
  return (299 * red + 587 * green + 114 * blue + 500) / 1000;
}

}  // namespace scarf
