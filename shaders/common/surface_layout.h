// Push constants of the surfaces that keep one value per pixel. Read by shaders and C++.
#ifndef SCARF_SHADERS_SURFACE_LAYOUT_H
#define SCARF_SHADERS_SURFACE_LAYOUT_H
#include "layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#endif

// last_event, and the stages that follow it: one submission of events.
struct SurfacePush {
  uint first_event;  // index of the first event in the staging buffer
  uint events;
  uint width;
  uint height;
  uint planes;       // 2: one plane per polarity
  uint reach;        // age: pixels of the window on each side of its centre
  uint stamp;        // of the first event; see last_event.comp
  uint t_first_low;  // last_time: time of the stream's first event
  uint t_first_high;
};

// last_time_fill: all times become one.
struct FillTimesPush {
  uint times;
  uint low;
  uint high;
};

// sae_age: all pixels.
struct SaeAgePush {
  uint pixels;
  uint planes;
  uint now_low;  // T relative to the stream's first event
  uint now_high;
  uint step;     // microseconds per entry of the table
  uint reach;    // ages from here on take the table's last entry
  uint last;     // that entry
};

// age_limit: all pixels.
struct AgeLimitPush {
  uint pixels;
  uint never;    // what pixels become that never fired
};

// Ages: bits 0..30 count, bit 31 says that the pixel never fired.
#ifdef __cplusplus
inline constexpr uint kAgeNever = 0x80000000u;
#else
const uint kAgeNever = 0x80000000u;
#endif

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
