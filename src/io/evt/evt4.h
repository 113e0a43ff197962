// EVT4: Prophesee's format of 32-bit words, each with its type in the upper four bits; EVT2's fields, and
// masks of 32 pixels of a row. Source: the decoder of OpenEB 5.1.
#pragma once

#include <cstdint>

#include "io/evt/evt2.h"

namespace scarf::evt4 {

enum Type : uint32_t {
  kOther = 0x6,
  kContinued = 0x7,
  kTrigger = 0x9,    // time b27..22, input b12..8, value b0
  kOff = 0xA,        // time b27..22 (lower six bits), x b21..11, y b10..0
  kOn = 0xB,         // the same
  kVectorOff = 0xC,  // the same; the next word is a mask without a type: an event at x + i for bit i
  kVectorOn = 0xD,
  kTimeHigh = 0xE,  // b27..0: the time's bits 33..6
  kPadding = 0xF,
};

inline constexpr size_t kMaskLength = 32;

}  // namespace scarf::evt4
