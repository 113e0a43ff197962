// SCARF, stage "scan": per patch, the chunks' hits become cursors, and head and laps advance.
// CPU twin: cpu_ref/stages/scarf/scarf_scan.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/layout.h"
layout(local_size_x = kLinearGroup) in;
#include "common/invocation.glsl"
#include "common/ring_head.glsl"
#include "common/views.glsl"

WORDS_VIEW(0, SumsView, sums)  // see running_sums.comp
layout(std430, binding = 1) readonly buffer PatchClasses { uint classes[]; };  // before the first | last << 16, per
                                                                               // column of patches, then row
layout(std430, binding = 2) buffer TableBuffer { uint table[]; };              // cursors per chunk and patch
layout(std430, binding = 3) buffer Heads { uint heads[]; };                    // see ring_head.glsl
layout(std430, binding = 4) buffer Laps { uint64_t laps[]; };
layout(std430, binding = 5) buffer PaintedHeads { uint painted_heads[]; };     // see scarf_paint.comp
layout(push_constant) uniform Push { ScanPush pushed; };
ScanPush push = pushed;

uint sum_at(uint entry) { return VIEW_WORD(sums, entry); }

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
    const uint count = sum_at(base + below + right) - sum_at(base + below + left) - sum_at(base + above + right) +
                       sum_at(base + above + left);
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
    table[entry] = skip == count ? kCursorDead : skip * kCursorSkipOne + (head_slot(head) + rank + skip) % push.capacity;
    rank += count;
  }
  const uint end = head_slot(head) + hits;
  const uint64_t filled = (head >> 16) + end / push.capacity;
  heads[patch_id] = end % push.capacity;
  if (filled != 0) laps[patch_id] += filled;
  if (filled != 0 || hits != 0) painted_heads[patch_id] = kNeverPainted;
}
