// The walk over the hits of a batch.
#pragma once

#include <algorithm>
#include <span>

#include "scarf/event.h"
#include "shaders/layout.h"

namespace scarf::stages {

/// Calls hit(chunk, event, i, j) for each patch (i, j) of each event, in order.
template <class Hit>
void for_each_hit(std::span<const Event> events, std::span<const uint32_t> ranges,
                  const layout::BatchPush& push, Hit hit) {
  for (uint32_t e = 0; e < push.events; ++e) {
    const Event& event = events[push.first_event + e];
    const uint32_t columns = ranges[std::min<uint32_t>(event.x, push.width)];
    const uint32_t rows = ranges[push.width + 1 + std::min<uint32_t>(event.y, push.height)];
    for (uint32_t j = rows & 0xFFFF; j <= rows >> 16; ++j) {
      for (uint32_t i = columns & 0xFFFF; i <= columns >> 16; ++i) hit(e / push.chunk_events, event, i, j);
    }
  }
}

}  // namespace scarf::stages
