// SCARF, stage "scan": per patch, the chunks' hits become cursors, and head and total advance.
// CPU twin: cpu_ref/stages/scarf_scan.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
layout(local_size_x = kLinearGroup) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Sums { uint sums[]; };              // see scarf_sum.comp
layout(std430, binding = 1) readonly buffer PatchClasses { uint classes[]; };  // before the first | last << 16, per
                                                                               // column of patches, then row
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };              // cursors per chunk and patch
layout(std430, binding = 3) buffer Heads { uint heads[]; };                    // next slot to write: total mod capacity
layout(std430, binding = 4) buffer Totals { uvec2 totals[]; };                 // events ever pushed, low and high word
layout(std430, binding = 5) buffer Dirty { uint dirty[]; };                    // 1: the patch is not painted yet
layout(push_constant) uniform Push { ScanPush push; };

void main() {
  const uint patch_id = linear_index();
  if (patch_id >= push.patches) return;
  const uint columns = classes[patch_id % push.grid_x];
  const uint rows = classes[push.grid_x + patch_id / push.grid_x];
  const uint above = (rows & 0xFFFF) * push.class_columns;
  const uint below = (rows >> 16) * push.class_columns;
  const uint left = columns & 0xFFFF;
  const uint right = columns >> 16;
  uint hits = 0;
  // Trips: 2 * (chunks + 1); Plan::max_chunks keeps them below the device's limit.
  for (uint c = 0; c < push.chunks; ++c) {
    const uint base = c * push.class_words;
    const uint count =
        sums[base + below + right] - sums[base + below + left] - sums[base + above + right] + sums[base + above + left];
    table[c * push.patches + patch_id] = count;
    hits += count;
  }

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
  if (hits != 0) dirty[patch_id] = 1;
}
