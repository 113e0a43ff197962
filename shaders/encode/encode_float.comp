// Encodings, stage "float": integers become floats, rounded once to nearest, half to even, in integer arithmetic.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 1) writeonly buffer Tensor { uint tensor[]; };  // bits of floats
layout(push_constant) uniform Push { EncodePush pushed; };
EncodePush push = pushed;

// The bits of the float nearest to number / 2^scale.
uint float_bits(int64_t number, int scale) {
  if (number == 0) return 0;
  uint64_t size = uint64_t(abs(number));
  const uvec2 words = unpackUint2x32(size);
  int exponent = words.y != 0 ? 32 + findMSB(words.y) : findMSB(words.x);  // of the leading bit
  if (exponent > 23) {
    const int dropped = exponent - 23;
    const uint64_t rest = size & (uint64_t(1) << dropped) - 1;
    const uint64_t half_unit = uint64_t(1) << dropped - 1;
    size >>= dropped;
    size += uint(rest > half_unit) | uint(rest == half_unit) & uint(size) & 1;
    if (size >> 24 != 0) {  // rounded up to the next power of two
      size >>= 1;
      ++exponent;
    }
  } else {
    size <<= 23 - exponent;
  }
  return (number < 0 ? 0x80000000u : 0) | uint(exponent + 127 - scale) << 23 | uint(size) & 0x7FFFFFu;
}

void main() {
  const uint value = linear_index();
  if (value >= push.values) return;
  if (push.mode == 2) {
    const uint64_t sum = packUint2x32(uvec2(numbers[2 * value], numbers[2 * value + 1]));
    tensor[value] = float_bits(int64_t(sum), int(kEncodeWeightBits));
  } else {
    // The event image: counts, then weights.
    const bool is_weight = value >= push.values / 2;
    tensor[value] = float_bits(int64_t(numbers[value]), is_weight ? int(kEncodeWeightBits) : 0);
  }
}
