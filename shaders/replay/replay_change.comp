// Replay, stage "change": each event is shown from its own interval on, until capacity more events have hit its patch.
// Those that outlast the group are kept for the next one. A workgroup per chunk.
// CPU twin: cpu_ref/stages/replay/replay_change.cpp
#version 460
#extension GL_GOOGLE_include_directive : require
#include "replay/replay_layout.h"
layout(local_size_x = kLinearGroup) in;
#include "replay/replay.glsl"
#include "replay/replay_changes.glsl"
#include "common/views.glsl"

WORDS_VIEW(7, RanksView, ranks)

// Each slot is written at most once: the ranks that outlast the group are the last ones of the patch, and distinct mod
// capacity. What it held, if anything, has been dropped by replay_carry.comp.
void keep(uint patch_id, uint pixel, uint rank) {
  const uint hits = hits_by(push.chunks - 1, patch_id);
  const uint age = hits - rank;  // 1 .. capacity
  const uint head = head_behind(patch_id);
  const uint slot = head >= age ? head - age : head + push.capacity - age;
  pixels[patch_id * push.capacity + slot] = pixel;
  atomicOr(kept[patch_id * push.kept_words + slot / 32], 1u << slot % 32);
}

void main() {
  const uint chunk = linear_workgroup();
  if (chunk >= push.chunks) return;
  const uint end = chunk_begin(chunk + 1);
  const uint shown = chunk_interval(chunk);
  // Trips: kMaxChunkEvents / kLinearGroup, of at most 19 each for the search.
  for (uint e = chunk_begin(chunk) + gl_LocalInvocationID.x; e < end; e += kLinearGroup) {
    const uint xy = event_at(e);
    const uint owner = owner_of(xy);
    if (owner == kReplayNone) continue;
    const uint patch_id = (owner >> 16) * push.grid_x + (owner & 0xFFFF);
    const uint rank = VIEW_WORD(ranks, e);
    const uint gone_in = chunk_beyond(patch_id, chunk, int(rank + push.capacity));
    const uint gone = gone_in < push.chunks ? chunk_interval(gone_in) : kReplayNone;
    if (gone == shown) continue;  // no frame sees it
    const uint pixel = (xy >> 16) * push.width + (xy & 0xFFFF);
    change(shown, pixel, 1);
    if (gone != kReplayNone)
      change(gone, pixel, -1);
    else
      keep(patch_id, pixel, rank);
  }
}
