// The patches that hold an event: first | last << 16 of the columns and of the rows.
layout(binding = 3) uniform usamplerBuffer ranges;

uint columns_of(uint xy) { return texelFetch(ranges, int(xy & 0xFFFF)).x; }
uint rows_of(uint xy) { return texelFetch(ranges, int(push.width + 1 + (xy >> 16))).x; }
