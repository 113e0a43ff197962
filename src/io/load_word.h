// Little-endian words at any address.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace scarf {

template <class Word>
Word load_word(const uint8_t* from) {
  static_assert(std::endian::native == std::endian::little);
  Word word;
  std::memcpy(&word, from, sizeof(Word));
  return word;
}

}  // namespace scarf
