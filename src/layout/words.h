// Times as the two 32-bit words that shaders take.
#pragma once

#include <cstdint>

namespace scarf {

inline uint32_t low_word(int64_t t) {
  return static_cast<uint32_t>(static_cast<uint64_t>(t));
}
inline uint32_t high_word(int64_t t) {
  return static_cast<uint32_t>(static_cast<uint64_t>(t) >> 32);
}

}  // namespace scarf
