// SCARF, stage "scan": per patch, the chunks' hit counts become cursors, and head and total advance.
// CPU twin: cpu_ref/stages/scarf_scan.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(std430, binding = 0) buffer TableBuffer { uint table[]; };  // hit counts before, cursors after
layout(std430, binding = 1) buffer Heads { uint heads[]; };        // next slot to write: total mod capacity
layout(std430, binding = 2) buffer Totals { uvec2 totals[]; };     // events ever pushed, low and high word
layout(push_constant) uniform Push { ScanPush push; };

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  uint hits = 0;
  // Trips: 2 * (chunks + 1); Plan::max_chunks keeps them below the device's limit.
  for (uint c = 0; c < push.chunks; ++c) hits += table[c * push.patches + patch_id];

  // Of the batch's hits on this patch, numbered 0 .. hits-1, only the last `capacity` survive.
  const uint overwritten = hits > push.capacity ? hits - push.capacity : 0;
  const uint head = heads[patch_id];
  uint rank = 0;
  for (uint c = 0; c < push.chunks; ++c) {
    const uint entry = c * push.patches + patch_id;
    const uint count = table[entry];
    const uint skip = overwritten > rank ? min(overwritten - rank, count) : 0;
    table[entry] = skip == count ? kCursorDead : skip * kCursorSkipOne + (head + rank + skip) % push.capacity;
    rank += count;
  }
  heads[patch_id] = (head + hits) % push.capacity;
  uint carry;
  const uint low = uaddCarry(totals[patch_id].x, hits, carry);
  totals[patch_id] = uvec2(low, totals[patch_id].y + carry);
}
