// The span of the events' times. Include it after encode.glsl, with SPAN_BINDING defined.
layout(std430, binding = SPAN_BINDING) readonly buffer Span { uint span[]; };

uint64_t first_time() { return packUint2x32(~uvec2(span[kSpanFirstLow], span[kSpanFirstHigh])); }
uint64_t last_time() { return packUint2x32(uvec2(span[kSpanLastLow], span[kSpanLastHigh])); }

// The unit of time is the smallest power of two microseconds that makes the length less than 2^40, so that ratios fit
// 64 bits.
uint time_unit() {
  const uint high = unpackUint2x32(last_time() - first_time()).y;
  return high == 0 ? 0 : uint(max(0, findMSB(high) + 32 + 1 - 40));
}
uint64_t since_first(uint64_t t) { return t - first_time() >> time_unit(); }

// numerator / denominator as a weight, rounded half to even; 0 <= numerator <= denominator < 2^40.
uint rounded_weight(uint64_t numerator, uint64_t denominator) {
  const uint64_t scaled = numerator << kEncodeWeightBits;
  const uint64_t quotient = scaled / denominator;
  const uint64_t twice = 2 * (scaled - quotient * denominator);
  return uint(quotient) + (uint(twice > denominator) | uint(twice == denominator) & uint(quotient) & 1);
}
