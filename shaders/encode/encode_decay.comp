// Encoding time surface, stage "decay": ages become values by table, copied as bits. Where nothing fired the age is the
// largest number that there is, and its value the last one of the table, 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Ages { uvec2 ages[]; };       // complements
layout(std430, binding = 1) readonly buffer Values { uint values[]; };    // by age
layout(std430, binding = 2) writeonly buffer Tensor { uint tensor[]; };   // bits of floats
layout(push_constant) uniform Push { EncodePush pushed; };
EncodePush push = pushed;

void main() {
  const uint value = linear_index();
  if (value >= push.values) return;
  const uint64_t age = packUint2x32(~ages[value]);
  tensor[value] = values[uint(min(age, uint64_t(push.end)))];
}
