// When events cease to be shown, and what that changes. Include it after replay.glsl.
#include "common/views.glsl"

WORDS_VIEW(2, TableView, table)  // per chunk and patch: hits by its end
WORDS_VIEW(3, HeadsView, heads)  // per patch two: before and behind the group
layout(std430, binding = 4) buffer Changes { uint changes[]; };        // per interval: counts of pixels, packed
layout(std430, binding = 5) buffer Kept { uint kept[]; };              // per patch: one bit per slot
layout(std430, binding = 6) buffer Pixels { uint pixels[]; };          // per patch and slot: valid if kept

uint hits_by(uint chunk, uint patch_id) { return VIEW_WORD(table, chunk * push.stride + patch_id); }
uint head_before(uint patch_id) { return VIEW_WORD(heads, 2 * patch_id); }
uint head_behind(uint patch_id) { return VIEW_WORD(heads, 2 * patch_id + 1); }

// The first chunk from `first` on by whose end the patch has had more than `hits` hits of this group; push.chunks if
// there is none. The entries of a patch do not fall from chunk to chunk.
uint chunk_beyond(uint patch_id, uint first, int hits) {
  uint low = first;
  uint high = push.chunks;
  // Trips: at most 17, as there are at most 2^16 chunks and the range halves.
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (int(hits_by(middle, patch_id)) > hits)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// Adds `one` (1 or -1) to the count of a pixel from an interval on. Words are sums modulo 2^32, which do not depend on
// order; borrows between the pixels of a word cancel, see docs/architecture/replay.md.
void change(uint interval, uint pixel, int one) {
  const uint bit = pixel * push.count_bits;
  atomicAdd(changes[interval * push.change_words + bit / 32], uint(one) << bit % 32);
}
