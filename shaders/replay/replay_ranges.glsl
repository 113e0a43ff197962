// The patches that hold an event: first | last << 16 of the columns and of the rows.
#include "common/views.glsl"

WORDS_VIEW(3, RangesView, ranges)

uint columns_of(uint xy) { return VIEW_WORD(ranges, xy & 0xFFFF); }
uint rows_of(uint xy) { return VIEW_WORD(ranges, push.width + 1 + (xy >> 16)); }
