// Four pixels through all frames of a group. Include it after the local size is declared.
#include "common/invocation.glsl"
#include "common/views.glsl"

layout(constant_id = 0) const uint kCountBits = 8;  // of a pixel's count: 8, or 16

WORDS_VIEW(0, ChangesView, changes)  // per interval
layout(std430, binding = 1) buffer Counts { uint counts[]; };  // before the group; then behind it
WORDS_VIEW(2, LevelsView, levels)  // brightness of 0 .. capacity
layout(push_constant) uniform Push { ReplayFramesPush pushed; };
ReplayFramesPush push = pushed;

// Counts of four pixels: one word of 8 bits each, or two words of 16.
uvec2 read_counts(uint index) {
  return kCountBits == 8 ? uvec2(counts[index], 0) : uvec2(counts[2 * index], counts[2 * index + 1]);
}
void write_counts(uint index, uvec2 packed) {
  if (kCountBits == 8) {
    counts[index] = packed.x;
  } else {
    counts[2 * index] = packed.x;
    counts[2 * index + 1] = packed.y;
  }
}
uvec2 changes_in(uint interval, uint index) {
  const int word = int(interval * push.invocations + index);
  if (kCountBits == 8) return uvec2(VIEW_WORD(changes, word), 0);
  return uvec2(VIEW_WORD(changes, 2 * word), VIEW_WORD(changes, 2 * word + 1));
}
uint level_of(uint count) { return VIEW_WORD(levels, count); }

uvec4 unpack_counts(uvec2 packed) {
  return kCountBits == 8 ? packed.xxxx >> uvec4(0, 8, 16, 24) & 0xFF : packed.xxyy >> uvec4(0, 16, 0, 16) & 0xFFFF;
}
