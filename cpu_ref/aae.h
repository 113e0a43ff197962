// The walk of AAE through the queue of one block.
#pragma once

#include <cstddef>
#include <span>

#include "scarf/core/event.h"

namespace scarf {

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
