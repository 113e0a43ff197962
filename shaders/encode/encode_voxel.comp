// Encoding VoxelGrid, stage "voxel": each event is split over two bins of time.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "encode/encode_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "encode/encode.glsl"
#define SPAN_BINDING 3
#include "encode/encode_span.glsl"

layout(std430, binding = 4) buffer Sums { uint sums[]; };  // low and high words of 64-bit sums

// Which event's addition carries depends on who comes first, but how many do does not: the sum is exact.
void add(uint value, int64_t number) {
  const uvec2 words = unpackUint2x32(uint64_t(number));
  const uint before = atomicAdd(sums[2 * value], words.x);
  const uint high = words.y + (before + words.x < before ? 1 : 0);
  if (high != 0) atomicAdd(sums[2 * value + 1], high);
}

void main() {
  const uint i = linear_index();
  if (i >= events()) return;
  const uvec4 event = event_at(i);
  if (!is_inside(event)) return;
  const uint64_t length = max(since_first(last_time()), uint64_t(1));
  const uint64_t place = (push.planes - 1) * since_first(time_of(event));
  const uint64_t bin = place / length;
  const uint right = rounded_weight(place - bin * length, length);
  const uint left = (1u << kEncodeWeightBits) - right;

  const bool per_polarity = push.mode == 1;
  const int64_t sign = per_polarity || polarity_plane(event) == 0 ? 1 : -1;
  const uint plane = uint(bin) + (per_polarity ? polarity_plane(event) * push.planes : 0);
  const uint area = push.width * push.height;
  const uint value = plane * area + pixel_of(event);
  add(value, sign * int64_t(left));
  // Behind the last bin there is none; there place is its number exactly, and right is 0.
  if (right != 0) add(value + area, sign * int64_t(right));
}
