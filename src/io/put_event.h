// Events written in two stores.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scarf/event.h"

namespace scarf {

/// Makes `out` the event with these fields. Compilers store the members of a struct one by one, and a value
/// put together beforehand they pass through memory: either takes longer than the decoding of an event.
inline void put_event(Event& out, int64_t t, uint32_t x, uint32_t y, uint32_t p) {
  static_assert(std::endian::native == std::endian::little && offsetof(Event, y) == 10);
  const uint64_t rest = uint64_t{p} << 32 | y << 16 | x;
  std::memcpy(&out.t, &t, sizeof t);
  std::memcpy(reinterpret_cast<unsigned char*>(&out) + offsetof(Event, x), &rest, sizeof rest);
}

}  // namespace scarf
