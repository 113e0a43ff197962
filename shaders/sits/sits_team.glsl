// The team of SITS: one subgroup, which is a whole workgroup, takes events one after the other.
//
// Values come in pairs: two pixels of a row, the first in an even column. Lane (a, b) of the team owns the pairs (x, y)
// with x = a mod kTeamX and y = b mod kTeamY: it alone reads and writes them, in the order of the events, so values
// need no atomics and no barriers. The value at the centre of a window travels from its owner to the others by a
// shuffle.
//
// To be defined before it is included: push, and
//   uint place_of(ivec2 pair)         where a pair is
//   ivec2 values_at(uint place)
//   void set_values(uint place, ivec2 values)

#include "common/bits.glsl"

ivec2 lane_position() {
  return ivec2(gl_SubgroupInvocationID % kTeamX, gl_SubgroupInvocationID / kTeamX);
}

ivec2 pair_of(ivec2 pixel) { return ivec2(pixel.x >> 1, pixel.y); }

int centre_value(ivec2 centre) {
  const ivec2 pair = pair_of(centre);
  const uvec2 position = uvec2(pair) % uvec2(kTeamX, kTeamY);
  const uint owner = position.y * kTeamX + position.x;
  ivec2 values = ivec2(0);
  if (gl_SubgroupInvocationID == owner) values = values_at(place_of(pair));
  return subgroupShuffle(blend(all_if(uint(centre.x), 1), values.y, values.x), owner);
}

struct Window {
  ivec2 centre;
  int before;      // value at the centre before the event
  ivec2 first;     // pixels
  ivec2 last;
  int own_column;  // first column of pairs that is the lane's
  int end_column;  // where it goes on in the next row
};

// The lane's next pair, or one beyond the last row.
ivec2 next_pair(Window w, ivec2 pair) {
  const int x = pair.x + int(kTeamX);
  return x < w.end_column ? ivec2(x, pair.y) : ivec2(w.own_column, pair.y + int(kTeamY));
}

bool is_in(Window w, ivec2 pair) { return 2 * pair.x <= w.last.x && pair.y <= w.last.y; }

// Of one pixel.
int value_after(Window w, ivec2 pixel, int value) {
  if (pixel == w.centre) return push.white;
  const bool after = pixel.x > w.centre.x || pixel.x == w.centre.x && pixel.y > w.centre.y;
  const int least = w.before + (after ? push.least_after : push.least_before);
  return pixel.x >= w.first.x && pixel.x <= w.last.x && value >= least ? value - 1 : value;
}

ivec2 values_after(Window w, ivec2 pair, ivec2 values) {
  const ivec2 pixel = ivec2(2 * pair.x, pair.y);
  return ivec2(value_after(w, pixel, values.x), value_after(w, pixel + ivec2(1, 0), values.y));
}

// One event: its window, clipped to the pixels first .. last. A block is kTeamX x kTeamY pairs, one of each lane; some
// are taken together, because loads that do not wait for each other are faster. Trips: 1 + blocks / kSitsBlocksPerTrip.
void fire(ivec2 centre, int before, ivec2 first, ivec2 last) {
  const ivec2 first_pair = pair_of(first);
  const ivec2 team = ivec2(kTeamX, kTeamY);
  const uvec2 blocks = uvec2(pair_of(last) - first_pair) / uvec2(team) + 1;
  ivec2 pair = first_pair + ((lane_position() - first_pair) & (team - 1));
  const Window w = Window(centre, before, first, last, pair.x, pair.x + int(blocks.x * kTeamX));
  for (uint block = 0; block < blocks.x * blocks.y; block += kSitsBlocksPerTrip) {
    const ivec2 pair_0 = pair;
    const ivec2 pair_1 = next_pair(w, pair_0);
    const ivec2 pair_2 = next_pair(w, pair_1);
    const bool in_0 = is_in(w, pair_0);
    const bool in_1 = is_in(w, pair_1);
    const bool in_2 = is_in(w, pair_2);
    ivec2 values_0 = ivec2(0);
    ivec2 values_1 = ivec2(0);
    ivec2 values_2 = ivec2(0);
    if (in_0) values_0 = values_at(place_of(pair_0));
    if (in_1) values_1 = values_at(place_of(pair_1));
    if (in_2) values_2 = values_at(place_of(pair_2));
    if (in_0) set_values(place_of(pair_0), values_after(w, pair_0, values_0));
    if (in_1) set_values(place_of(pair_1), values_after(w, pair_1, values_1));
    if (in_2) set_values(place_of(pair_2), values_after(w, pair_2, values_2));
    pair = next_pair(w, pair_2);
  }
}
