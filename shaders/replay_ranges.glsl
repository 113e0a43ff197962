// The patches that hold an event: first | last << 16 of the columns and of the rows.
layout(std430, binding = 3) readonly buffer Ranges { uint ranges[]; };

uint columns_of(uint xy) { return ranges[xy & 0xFFFF]; }
uint rows_of(uint xy) { return ranges[push.width + 1 + (xy >> 16)]; }
