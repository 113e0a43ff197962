// The blocks of AAE, and the walk through the queue of one.
#pragma once

#include <cstddef>
#include <span>

#include "scarf/event.h"
#include "scarf/parameters.h"

namespace scarf {

/// Blocks in raster order; those at the right and lower border may reach beyond the sensor.
struct BlockGrid {
  int32_t width = 1;  ///< of a block, pixels
  int32_t height = 1;
  int32_t columns = 1;
  int32_t rows = 1;

  size_t blocks() const { return static_cast<size_t>(columns) * rows; }
  size_t block_of(const Event& e) const { return static_cast<size_t>(e.y / height) * columns + e.x / width; }
};
BlockGrid block_grid(const AaeParameters& parameters, SensorSize sensor);

struct BlockWalk {
  size_t drawn = 0;   ///< how many of the newest events are drawn
  size_t passed = 0;  ///< how many of the newest events the queue keeps
  /// A test came within 1e-9 of its threshold, so that rounding may decide where the walk stops.
  bool close = false;
};

/// The walk of one query, from the newest event of a queue (oldest first) to where it stops.
BlockWalk walk_block(std::span<const Event> queue);
BlockWalk walk_block_esvo2(std::span<const Event> queue);

}  // namespace scarf
