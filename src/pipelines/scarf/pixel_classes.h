// Classes of pixels: the columns (or rows) of the sensor that lie in the same patches. An event is counted
// once, in its class, however many patches hold it.
#pragma once

#include <cstdint>
#include <vector>

#include "scarf/core/patch_grid.h"

namespace scarf {

/// One axis. Class 0 is what no patch holds, and what is outside the sensor; the others are numbered from 1
/// in the order of their pixels. A patch holds consecutive classes, because its pixels are consecutive.
struct PixelClasses {
  std::vector<uint32_t> of_pixel;  ///< for each pixel 0 .. size-1, and for one outside
  std::vector<uint32_t>
      of_patch;        ///< classes of each patch: (the one before the first) | last << 16; 0: none
  uint32_t count = 1;  ///< class 0 included
};

PixelClasses pixel_classes(const GridAxis& axis);

}  // namespace scarf
