// Constants and push constants of aed_sae, shared by the shaders and the host.
#ifndef SCARF_SHADERS_AED_SAE_LAYOUT_H
#define SCARF_SHADERS_AED_SAE_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Consecutive events of the log whose largest time is kept.
SCARF_CONSTANT kAedRun = 32;
// Pixels that one invocation clears or counts.
SCARF_CONSTANT kAedPixels = 32;

// Which runs of the log have new events (AedPush::range).
SCARF_CONSTANT kAedNew = 0;         // those of the submission
SCARF_CONSTANT kAedAfterClear = 1;  // those since its last clear, if there is one
SCARF_CONSTANT kAedAll = 2;

// The stages of a push.
struct AedPush {
  uint range;       // kAed...
  uint runs;        // at most
  uint group_runs;  // runs whose largest time is kept in turn
  uint events;      // of the submission, at most
  uint window;      // dT, microseconds
  uint width;       // sensor
  uint pixels;
  uint stamp;       // of the submission's first event; see aed_sae_last_event.comp
  uint steps;       // clears: of one dispatch
  uint begin;       // clears: 1 = the first dispatch
};

// The stages of a query.
struct AedImagePush {
  uint events;      // of the log, at most
  uint window;
  uint width;
  uint height;
  uint pixels;
  uint scale_low;   // lambda * dT as a double
  uint scale_high;
  uint peak_low;    // the filter's largest weight as a double
  uint peak_high;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
