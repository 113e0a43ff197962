// AAE, stage "sort_write": the events of each chunk, in order, to the places that the prefix sum gave. As the sum runs
// over digits first and chunks second, events of one digit stay in order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "aae/aae_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "aae/aae_sort.glsl"
#include "common/invocation.glsl"

layout(std430, binding = 3) writeonly buffer To { uvec4 to[]; };

void main() {
  const uint chunk = linear_index();
  if (chunk >= push.chunks) return;
  const uint begin = chunk * push.chunk_events;
  const uint end = min(begin + push.chunk_events, min(push.events, log_length));
  // Trips: chunk_events, at most 16,384.
  for (uint i = begin; i < end; ++i) {
    const uvec4 event = from[i];
    const uint entry = entry_of(event.z, chunk);
    const uint place = table[entry];
    to[place] = event;
    table[entry] = place + 1;
  }
}
