// Push constants of the lists of events per tile. Read by shaders and C++.
#ifndef SCARF_SHADERS_TILE_LISTS_LAYOUT_H
#define SCARF_SHADERS_TILE_LISTS_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#endif

// tile_lists_count, tile_lists_place, and the stages that read the lists.
struct TileListsPush {
  uint first_event;   // index of the submission's first event in the staging buffer
  uint events;
  uint chunk_events;  // a chunk is a contiguous run of events
  uint chunks;
  uint width;         // sensor
  uint height;
  uint tile;          // pixels per side of a tile
  uint halo;          // pixels around a tile whose events are in its list too
  uint tiles_x;
  uint tiles_y;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
