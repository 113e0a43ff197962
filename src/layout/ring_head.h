// The head of a patch's ring on a device: where its next event goes, and how many it ever received.
#pragma once

#include <cstdint>

namespace scarf {

// Bits 0..15 of a head are the slot of the next event, bits 16..31 the laps since these were last added to
// the laps of the ring: how often it was filled. The shaders see it the same way
// (shaders/common/ring_head.glsl).
inline constexpr int kHeadLapsShift = 16;
/// Laps that a head can hold.
inline constexpr uint64_t kMostHeadLaps = 65'535;

inline uint32_t head_slot(uint32_t head) {
  return head & 0xFFFF;
}
/// Events that the ring ever received.
inline uint64_t ring_total(uint32_t head, uint64_t laps, uint64_t capacity) {
  return (laps + (head >> kHeadLapsShift)) * capacity + head_slot(head);
}

}  // namespace scarf
