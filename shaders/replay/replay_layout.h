// Push constants of the replay, shared by the shaders and the host.
#ifndef SCARF_SHADERS_REPLAY_LAYOUT_H
#define SCARF_SHADERS_REPLAY_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// A patch, interval or entry that is none.
SCARF_CONSTANT kReplayNone = 0xFFFFFFFFu;

// Pixels of one invocation of the frames stages.
SCARF_CONSTANT kReplayPixels = 4;

// A contiguous run of events that no frame divides.
struct ReplayChunk {
  uint begin;     // its first event in the group
  uint interval;  // the frames of the group before it: its events are shown from the frame of that number on
};

// All stages but integrate and frames: the events of one group, cut into chunks.
struct ReplayPush {
  uint chunks;
  uint stride;          // words of the table per chunk: its patches, and one for each lane of a team to waste
  uint patches;
  uint width;           // sensor; the column ranges are ranges[0 .. width], the row ranges ranges[width + 1 ..]
  uint height;
  uint grid_x;
  uint grid_y;
  int origin_x;         // first pixel of the cell of patch 0, may be negative
  int origin_y;
  uint cell_x;
  uint cell_y;
  uint capacity;
  uint kept_words;      // words of 32 slots per patch
  uint change_words;    // words of changes per interval
  uint count_bits;      // of a pixel's count in a word of changes: 8 or 16
};

// frames: pictures from changes.
struct ReplayFramesPush {
  uint frames;
  uint invocations;    // kReplayPixels of a picture each
  uint levels_0_to_3;  // 8-bit levels of 0 .. 7, the first in the lowest bits
  uint levels_4_to_7;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
