// Push constants of SITS. Read by shaders and C++.
#ifndef SCARF_SHADERS_SITS_LAYOUT_H
#define SCARF_SHADERS_SITS_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#endif

// Blocks of the window that a lane of a team visits per trip of its loop; see sits_team.glsl.
#ifdef __cplusplus
inline constexpr uint kSitsBlocksPerTrip = 3;
#else
const uint kSitsBlocksPerTrip = 3;
#endif

// All stages.
struct SitsPush {
  uint first_event;    // index of the first event in the staging buffer
  uint events;
  uint width;          // sensor
  uint height;
  uint pairs_x;        // pairs of pixels per row of values; the last one is half empty if the width is odd
  int reach;           // pixels of the window on each side of its centre
  int white;           // what the centre becomes: k * k
  int least_before;    // a pixel loses 1 from (value at the centre + this) on: visited before the centre ...
  int least_after;     // ... and after it, column by column
  uint tiles_x;
  uint tiles_y;
  uint chunks;         // of the tile lists
  uint sweep;
  uint sweeps;         // of the submission, at most
  uint only_unsettled; // walk: 1 = only if the sweeps did not settle
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
