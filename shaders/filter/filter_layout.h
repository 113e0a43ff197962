// Push constants of the noise filters, shared by the shaders and the host.
#ifndef SCARF_SHADERS_FILTER_LAYOUT_H
#define SCARF_SHADERS_FILTER_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// All words of events outside every sensor.
SCARF_CONSTANT kFilterOutside = 0xFFFFFFFFu;

// Both words of a last time that is none: as a number further away than any time relative to the first event.
SCARF_CONSTANT kFilterNever = 0x80000000u;

// Where the words of a report are: of one submission, as atomics leave them, and of the stream.
SCARF_CONSTANT kFilterPassed = 0;
SCARF_CONSTANT kFilterRejected = 1;
SCARF_CONSTANT kFilterNewest = 2;       // place + 1 in the submission of the last event that passed; 0: none
SCARF_CONSTANT kFilterTotalPassed = 3;  // two words, low and high, like the next ones
SCARF_CONSTANT kFilterTotalRejected = 5;
SCARF_CONSTANT kFilterNewestTime = 7;  // valid if any event passed
SCARF_CONSTANT kFilterReportWords = 9;

// filter_support, filter_refractory: a part of each tile's list of events.
struct FilterPush {
  uint first_event;  // index of the submission's first event in the buffer that is read; 0 in that written
  uint begin;        // the part of each list, from its beginning
  uint end;
  uint chunks;  // of the table that says where lists begin
  uint tiles;
  uint tiles_x;
  uint tile;    // pixels per side
  uint range;   // support: pixels around an event that may support it
  uint width;   // sensor
  uint period;  // microseconds
  uint t_first_low;
  uint t_first_high;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
