// The eight bytes of a slot; the host's side is src/layout/packed_event.h. Needs 64-bit integers.
// Bits 0..6 patch-local x, 7..13 patch-local y, 14 polarity, 15..63 signed microseconds since the first event.
// An empty slot: the time -2^48, which no stored event has.
const uint64_t kEmptySlot = 0x8000000000000000ul;

uint64_t pack_time(uint64_t t) { return t << 15; }
uint pack_polarity(uint p) { return p << 14; }
uint pack_position(uint x, uint y) { return (x & 127) | (y & 127) << 7; }

// An event as the host sees it (16 bytes).
uvec4 unpack_event(uvec2 word, int field_x, int field_y, uint64_t t_first) {
  const uint64_t t = t_first + uint64_t(int64_t(packUint2x32(word)) >> 15);
  const uint x = uint(field_x + int(word.x & 127));
  const uint y = uint(field_y + int(word.x >> 7 & 127));
  return uvec4(unpackUint2x32(t), x | y << 16, word.x >> 14 & 1);
}
uint packed_x(uint low_word) { return low_word & 127; }
uint packed_y(uint low_word) { return low_word >> 7 & 127; }
uint packed_polarity(uint low_word) { return low_word >> 14 & 1; }
