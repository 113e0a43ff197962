// Events written in two stores.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scarf/core/event.h"

namespace scarf {

/// The bytes of an event behind its time as one number: x in bits 15..0, y in 31..16, p in 39..32.
constexpr uint64_t event_fields(uint64_t x, uint64_t y, uint64_t p) {
  return p << 32 | y << 16 | x;
}

/// Makes `out` the event with this time and these event_fields. Compilers store the members of a struct one
/// by one, and a value put together beforehand they pass through memory: either takes longer than the
/// decoding of an event.
inline void put_event(Event& out, int64_t t, uint64_t fields) {
  static_assert(std::endian::native == std::endian::little && offsetof(Event, y) == 10 &&
                offsetof(Event, p) == 12);
  std::memcpy(&out.t, &t, sizeof t);
  std::memcpy(reinterpret_cast<unsigned char*>(&out) + offsetof(Event, x), &fields, sizeof fields);
}

inline void put_event(Event& out, int64_t t, uint32_t x, uint32_t y, uint32_t p) {
  put_event(out, t, event_fields(x, y, p));
}

}  // namespace scarf
