// What a patch keeps of an event: the place and append stages. Include it after push constants that have the grid and the
// margins.
#include "common/packed_event.glsl"
#include "common/active.glsl"
#include "common/first_owned.glsl"

// An event on its way to its patches.
struct Walked {
  uint columns;  // first | last << 16 of the patches that hold it
  uint rows;
  uint xy;       // x | y << 16
  uvec2 word;    // time and polarity, packed
};

// The slot of a hit on patch (i, j).
uvec2 slot_of(Walked e, uint i, uint j) {
  const uint field_x = uint(push.field_x) + i * push.cell_x;  // fields may begin outside the sensor and wrap,
  const uint field_y = uint(push.field_y) + j * push.cell_y;  // pixels of events never do
  return uvec2(e.word.x | pack_position((e.xy & 0xFFFF) - field_x, (e.xy >> 16) - field_y), e.word.y);
}

// Its position in the picture of the patch's cell; see kNotShown.
uint position_of(uvec2 slot) {
  const uint x = packed_x(slot.x) - push.margin_lo_x;
  const uint y = packed_y(slot.x) - push.margin_lo_y;
  return is_active(slot.x) ? y * push.row_bytes + x : kNotShown;
}
