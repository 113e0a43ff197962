// Push constants of time_window with counts, shared by the shaders and the host.
#ifndef SCARF_SHADERS_TIME_WINDOW_LAYOUT_H
#define SCARF_SHADERS_TIME_WINDOW_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#endif

// time_window_count: the events of the log.
struct TimeWindowPush {
  uint events;      // at most
  uint width;
  uint since_low;   // microseconds; earlier events do not count
  uint since_high;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
