// Events as bytes, in digests and states: t i64, x u16, y u16, p u8, little-endian.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/little_endian.h"
#include "scarf/core/event.h"

namespace scarf {

inline void append_event(std::vector<uint8_t>& bytes, const Event& e) {
  append_little_endian(bytes, e.t);
  append_little_endian(bytes, e.x);
  append_little_endian(bytes, e.y);
  append_little_endian(bytes, e.p);
}

/// How many events there are (u64), and the events.
inline void append_list(std::vector<uint8_t>& bytes, std::span<const Event> events) {
  append_little_endian(bytes, uint64_t{events.size()});
  for (const Event& e : events) append_event(bytes, e);
}

}  // namespace scarf
