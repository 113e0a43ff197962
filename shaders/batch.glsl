// A batch of events in staging memory and the table of its chunks, as the count and place stages see them.
layout(std430, binding = 0) readonly buffer Events { uvec4 events[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Ranges { uint ranges[]; };   // first | last << 16 per column, then row
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };        // counts or cursors per chunk and patch
layout(push_constant) uniform Push { BatchPush push; };

// The patches that hold an event: first | last << 16 of the columns and of the rows; none if it is outside.
struct Field {
  uint columns;
  uint rows;
};

bool has_patches(Field field) {
  return (field.columns & 0xFFFF) <= field.columns >> 16 && (field.rows & 0xFFFF) <= field.rows >> 16;
}

Field field_of(uint xy) {
  return Field(ranges[min(xy & 0xFFFF, push.width)], ranges[push.width + 1 + min(xy >> 16, push.height)]);
}
