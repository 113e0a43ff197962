// Packed events to events as they are in memory, one invocation per event. The format: unpack_layout.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "decode/unpack_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Packed { uint packed[]; };     // the table of blocks, then their data
layout(std430, binding = 1) writeonly buffer Events { uvec4 events[]; };   // t low, t high, x | y << 16, p
layout(push_constant) uniform Push { UnpackPush pushed; };
UnpackPush push = pushed;

void main() {
  const uint e = linear_index();
  if (e >= push.events) return;
  const uint i = e % kPackedBlock;
  const uint entry = (push.first_block + e / kPackedBlock) * kPackedTableWords;
  const uint begin = packed[entry] >> 2;
  const uint form = packed[entry] & 3;
  if (form == kPackedRaw) {
    const uint at = begin + 4 * i;
    events[e] = uvec4(packed[at], packed[at + 1], packed[at + 2], packed[at + 3]);
    return;
  }
  const uint word = packed[begin + i];
  uint more = 0;
  if (form != 0) {
    const uint behind = begin + min(kPackedBlock, push.events - (e - i));
    more = bitfieldExtract(packed[behind + i * form / 4], int(i * form % 4 * 8), int(8 * form));
  }
  const uint place_bits = push.x_bits + push.y_bits + 1;
  const uint64_t offset = uint64_t(more) << (32 - place_bits) | word >> place_bits;
  const uint64_t t = packUint2x32(uvec2(packed[entry + 1], packed[entry + 2])) + offset;
  const uint x = bitfieldExtract(word, 0, int(push.x_bits));
  const uint y = bitfieldExtract(word, int(push.x_bits), int(push.y_bits));
  events[e] = uvec4(unpackUint2x32(t), x | y << 16, word >> (place_bits - 1) & 1);
}
