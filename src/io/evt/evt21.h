// EVT2.1: Prophesee's format of 64-bit words, each with its type in the upper four bits, and events as masks
// of 32 pixels of a row. Source: Prophesee, "EVT 2.1 Format"; the byte orders: OpenEB's RAW file reader.
#pragma once

#include <bit>
#include <cstdint>

#include "core/little_endian.h"
#include "io/base/prophesee_header.h"
#include "io/evt/evt2.h"

namespace scarf::evt21 {

enum Type : uint32_t {
  kNegative =
      0x0,  // time b59..54 (lower six bits), x b53..43, y b42..32, b31..0: an event at x + i for bit i
  kPositive = 0x1,  // the same
  kTimeHigh = 0x8,  // b59..32: the time's bits 33..6
  kTrigger = 0xA,   // time b59..54, input b44..40, value b32
  kOthers = 0xE,
  kContinued = 0xF,
};

inline constexpr size_t kWordBytes = 8;
inline constexpr size_t kMaskLength = 32;

inline uint64_t load_word(const uint8_t* from, ByteOrder order) {
  const auto word = load_little_endian<uint64_t>(from);
  return order == ByteOrder::legacy ? std::rotl(word, 32) : word;
}

}  // namespace scarf::evt21
