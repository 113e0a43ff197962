// The head of a patch's ring, and how often the ring was filled; the host's side is src/layout/ring_head.h. Needs 64-bit
// integers. Bits 0..15 of a head are the slot of the next event, bits 16..31 the laps that are not yet among the laps.
uint head_slot(uint head) { return head & 0xFFFF; }
uint64_t all_laps(uint head, uint64_t laps) { return laps + (head >> 16); }

// Slots in use.
uint filled_slots(uint head, uint64_t laps, uint capacity) {
  return all_laps(head, laps) != 0 ? capacity : head_slot(head);
}
