// AAE, stage "sort_count": how many events of each chunk have each digit. One invocation per chunk.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_sort.glsl"
#include "common/invocation.glsl"

void main() {
  const uint chunk = linear_index();
  if (chunk >= push.chunks) return;
  const uint begin = chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, min(push.events, log_length));
  // Trips: chunk_events, at most 16,384.
  for (uint i = begin; i < end; ++i) table[entry_of(from[i].z, chunk)] += 1;
}
