// Constants and push constants of the event log, shared by the shaders and the host.
#ifndef SCARF_SHADERS_EVENT_LOG_LAYOUT_H
#define SCARF_SHADERS_EVENT_LOG_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Consecutive events that one invocation copies: long enough that the sums over runs cost little.
SCARF_CONSTANT kLogRun = 32;

// Which events are copied.
SCARF_CONSTANT kKeepInside = 0;  // those on the sensor
SCARF_CONSTANT kKeepSince = 1;   // those from index `start` on that are not older than `since`
SCARF_CONSTANT kKeepNewest = 2;  // those from the index on that their block's entry says

// Invocations that look for the largest time of a log.
SCARF_CONSTANT kLargestTimes = 4096;

// event_log_count, event_log_write, event_log_largest.
struct EventLogPush {
  uint first;          // index of the first event
  uint events;         // at most; a log has as many as its length says
  uint width;          // sensor
  uint height;
  uint start;
  uint since_low;      // microseconds
  uint since_high;
  uint block_width;    // pixels
  uint block_height;
  uint block_columns;  // blocks per row of blocks
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
