// A batch of events in staging memory, as the count and place stages see it.
#include "common/events.glsl"
layout(push_constant) uniform Push { BatchPush pushed; };
BatchPush push = pushed;

// Where an event's column and row are found in tables of both; what is outside the sensor has an entry too.
uint column_entry(uint xy) { return min(xy & 0xFFFF, push.width); }
uint row_entry(uint xy) { return push.width + 1 + min(xy >> 16, push.height); }
