#include "io/evt/word_guess.h"

namespace scarf {

std::string_view guess_words(std::span<const uint8_t> bytes) {
  const bool evt2 = looks_like_evt2(bytes);
  // EVT2 and EVT2.1 have the same types, and each word of EVT2 may pass as a half of one of EVT2.1.
  const bool evt21 = looks_like_evt21(bytes) && !(evt2 && time_highs_at_every_place(bytes));
  const struct {
    std::string_view name;
    bool plausible;
  } guesses[] = {
      {"evt2", evt2}, {"evt21", evt21}, {"evt3", looks_like_evt3(bytes)}, {"evt4", looks_like_evt4(bytes)}};
  std::string_view only;
  for (const auto& guess : guesses) {
    if (!guess.plausible) continue;
    if (!only.empty()) return {};
    only = guess.name;
  }
  return only;
}

}  // namespace scarf
