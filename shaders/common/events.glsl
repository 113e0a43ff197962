// A buffer of events as they are in memory, and where they fall on the sensor.
#include "common/views.glsl"

VECTORS_VIEW(0, EventsView, events)  // t low, t high, x | y << 16, p
uvec4 event_at(uint index) { return VIEW_VECTOR(events, index); }

// The pixel of an event in row-major order; kOutside if it is not on the sensor.
const uint kOutside = 0xFFFFFFFFu;
uint pixel_of(uint xy, uint width, uint height) {
  const uint x = xy & 0xFFFF;
  const uint y = xy >> 16;
  return x < width && y < height ? y * width + x : kOutside;
}
