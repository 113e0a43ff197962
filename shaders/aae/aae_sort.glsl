// One pass of the stable counting sort of a log by block, as both of its stages see it.
layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Length { uint log_length; };
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };    // per digit and chunk
layout(push_constant) uniform Push { BlockSortPush pushed; };
BlockSortPush push = pushed;
#include "aae/aae_block.glsl"

// The entry that only the invocation of this chunk reads and writes.
uint entry_of(uint xy, uint chunk) { return block_of(xy) / push.divisor % push.digits * push.chunks + chunk; }
