// A patch of the state, as the render and extract stages see it.
layout(push_constant) uniform Push { PatchPush pushed; };
PatchPush push = pushed;
#include "common/active.glsl"

struct Patch {
  uint ring;    // index of its first slot
  int field_x;  // first pixel of its unclipped field
  int field_y;
};

Patch patch_of(uint patch_id) {
  const uint i = patch_id % push.grid_x;
  const uint j = patch_id / push.grid_x;
  return Patch(patch_id * push.capacity, push.field_x + int(i * push.cell_x), push.field_y + int(j * push.cell_y));
}
