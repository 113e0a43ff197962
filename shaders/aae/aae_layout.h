// Constants and push constants of aae, shared by the shaders and the host.
#ifndef SCARF_SHADERS_AAE_LAYOUT_H
#define SCARF_SHADERS_AAE_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Events of a block's queue.
SCARF_CONSTANT kLongestQueue = 100000;

// Events that one invocation walks in one dispatch; longer queues take several dispatches.
SCARF_CONSTANT kWalkSteps = 32768;

// aae_sort_count, aae_sort_write: one pass of a sort by block. Events are sorted by one digit of their block's number.
struct BlockSortPush {
  uint events;         // at most; the log has as many as its length says
  uint chunk_events;   // walked by one invocation
  uint chunks;
  uint divisor;        // digit = block / divisor % digits
  uint digits;
  uint block_width;    // pixels
  uint block_height;
  uint block_columns;  // blocks per row of blocks
};

// aae_ranges, aae_start, aae_walk, aae_forward, aae_backward, aae_cut.
struct AaePush {
  uint events;         // at most
  uint blocks;
  uint block_width;
  uint block_height;
  uint block_columns;
  uint width;          // sensor
  uint cut;            // aae_cut: which events stay, kCut...
};

SCARF_CONSTANT kCutToLongest = 0;  // the newest kLongestQueue of each block
SCARF_CONSTANT kCutToPassed = 1;   // those that the walk passed
SCARF_CONSTANT kCutAll = 2;        // none

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
