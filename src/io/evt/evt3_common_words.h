// The words that nearly all of EVT3 streams consist of, decoded without a branch where no branch predictor
// could follow: their order is that of the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scarf/core/event.h"

namespace scarf::evt3 {

/// What earlier words said.
struct Said {
  int64_t base = 0;       ///< time without the lower bits, microseconds
  uint32_t high = 0;      ///< the payload of the last TIME_HIGH
  uint32_t low = 0;       ///< the lower bits of the time
  uint32_t y = 0;         ///< the row, of brightness changes
  uint32_t vector_x = 0;  ///< base of the next vector
  uint32_t vector_p = 0;  ///< its polarity
};

/// Where the base of vectors stops: beyond every sensor, so that coordinates never wrap back into it.
inline constexpr uint32_t kLastVectorX = 0xF000;

struct CommonWords {
  size_t bytes = 0;   ///< taken from the front of the input: whole words
  size_t events = 0;  ///< at the front of the output
};

/// Decodes up to the first word that is not of the common ones: rows, columns, lower bits of times, repeated
/// TIME_HIGH words, words that mean nothing here, and vectors. Near the end of either span it may stop before
/// a vector or its base, too; never before a row, a column or lower bits that are whole and find room. Writes
/// unspecified events behind the last one.
CommonWords decode_common_words(std::span<const uint8_t> bytes, std::span<Event> out, Said& said);

}  // namespace scarf::evt3
