// SCARF, stage "paint": the 8-bit picture of the cells whose patches changed since they were last painted, from the
// positions that the place and append stages keep. For small cells and capacities, and levels that do not change beyond the
// eighth (Plan::paints); others take render and tone.
// CPU twin: cpu_ref/stages/scarf/scarf_paint.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_8bit_storage : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/views.glsl"

VECTORS_VIEW(0, PositionsView, positions)  // 16 slots; see kNotShown
layout(std430, binding = 1) readonly buffer Heads { uint heads[]; };           // see ring_head.glsl
layout(std430, binding = 2) buffer PaintedHeads { uint painted_heads[]; };  // when the cells were last painted
layout(std430, binding = 3) writeonly buffer Picture { uint8_t picture[]; };   // and bytes that nobody reads
layout(push_constant) uniform Push { PaintPush pushed; };
PaintPush push = pushed;

// Four pixels of a row of the cell each: at most 255 events, because the capacity is. One more for what is not shown.
uint counters[kPaintWords + 1];

// The highest bit of each byte of a word that is a position.
uint shown_in(uint word) { return (((~word & 0x7F7F7F7F) + 0x7F7F7F7F) | ~word) & 0x80808080; }
uvec4 shown_in(uvec4 words) { return uvec4(shown_in(words.x), shown_in(words.y), shown_in(words.z), shown_in(words.w)); }

void count(uint patch_id) {
  // Trips: kPaintWords; then at most 16 groups of at most 16 events, and their entries.
  for (uint w = 0; w < push.row_words * push.cell_y; ++w) counters[w] = 0;
  uint group = 0;
  do {
    const uvec4 words = VIEW_VECTOR(positions, patch_id * push.groups + group);
    uvec4 left = shown_in(words);
    do {
      // The next position in any of the four words.
      const uint word = left.x != 0 ? words.x : left.y != 0 ? words.y : left.z != 0 ? words.z : words.w;
      const uint bits = left.x != 0 ? left.x : left.y != 0 ? left.y : left.z != 0 ? left.z : left.w;
      const uint position = bits == 0 ? kNotShown : word >> (findLSB(bits) & 24) & 255;
      counters[position / 4] += 1 << 8 * (position & 3);
      const uint rest = bits & (bits - 1);
      if (left.x != 0) left.x = rest;
      else if (left.y != 0) left.y = rest;
      else if (left.z != 0) left.z = rest;
      else left.w = rest;
    } while (subgroupBallot((left.x | left.y | left.z | left.w) != 0) != uvec4(0));
  } while (++group < push.groups);
}

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  const uint head = heads[patch_id];
  if (head == painted_heads[patch_id]) return;
  painted_heads[patch_id] = head;
  count(patch_id);
  const uint x_begin = uint(push.cell_begin_x) + patch_id % push.grid_x * push.cell_x;  // cells may begin outside the
  const uint y_begin = uint(push.cell_begin_y) + patch_id / push.grid_x * push.cell_y;  // sensor, and wrap
  // Trips: at most 64 rows, 63 words and 252 pixels together, and their entries.
  uint y = 0;
  do {
    uint w = 0;
    do {
      uint four = counters[y * push.row_words + w];
      uint x = 4 * w;
      const uint x_end = min(x + 4, push.cell_x);
      do {
        const uint n = min(four & 255, kPushedLevels - 1);
        const uint level = (n < 4 ? push.levels_0_to_3 : push.levels_4_to_7) >> 8 * (n & 3) & 255;
        const bool inside = x_begin + x < push.width && y_begin + y < push.height;
        picture[inside ? (y_begin + y) * push.width + x_begin + x : push.width * push.height] = uint8_t(level);
        four >>= 8;
      } while (++x < x_end);
    } while (++w < push.row_words);
  } while (++y < push.cell_y);
}
