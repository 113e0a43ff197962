// The blocks of AAE.
#pragma once

#include <cstdint>

#include "scarf/core/event.h"
#include "scarf/core/parameters.h"

namespace scarf {

/// Blocks in raster order; those at the right and lower border may reach beyond the sensor.
struct BlockGrid {
  SensorSize block;  ///< pixels
  uint32_t columns = 0;
  uint32_t rows = 0;

  uint32_t blocks() const { return columns * rows; }
  uint32_t block_of(const Event& e) const { return e.y / block.height * columns + e.x / block.width; }
};

BlockGrid block_grid(const AaeParameters& parameters, SensorSize sensor);

}  // namespace scarf
