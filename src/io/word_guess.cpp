#include "io/word_guess.h"

namespace scarf {

std::string_view guess_words(std::span<const uint8_t> bytes) {
  const bool evt2 = looks_like_evt2(bytes);
  const bool evt3 = looks_like_evt3(bytes);
  if (evt2 == evt3) return {};
  return evt2 ? "evt2" : "evt3";
}

}  // namespace scarf
