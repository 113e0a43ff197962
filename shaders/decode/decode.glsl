// What the stages share that walk camera words: the words, and the run of them that a lane walks. Include it after the
// local size is declared. Formats: see src/io/evt/evt2.h and src/io/evt/evt3.h.
#include "decode/decode_layout.h"
#include "common/invocation.glsl"

layout(constant_id = 0) const uint kFormat = kDecodeEvt2;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(push_constant) uniform Push { DecodePush pushed; };
DecodePush push = pushed;

uint word_at(uint i) {
  return kFormat == kDecodeEvt2 ? words[i] : words[i >> 1] >> (i & 1) * 16 & 0xFFFF;
}
uint type_of(uint word) { return kFormat == kDecodeEvt2 ? word >> 28 : word >> 12; }

// The last runs may be short or empty.
uint run_begin() { return min(linear_index() * kDecodeRun, push.words); }
uint run_end() { return min(run_begin() + kDecodeRun, push.words); }
