// EVT2: Prophesee's format of 32-bit words, each with its type in the upper four bits.
// Source: Prophesee, "EVT 2.0 Format".
#pragma once

#include <cstdint>

#include "io/high_counter.h"

namespace scarf::evt2 {

enum Type : uint32_t {
  kOff = 0x0,       // time b27..22 (lower six bits), x b21..11, y b10..0
  kOn = 0x1,        // the same
  kTimeHigh = 0x8,  // b27..0: the time's bits 33..6
  kTrigger = 0xA,
  kImu = 0xD,  // begins a block of kImuWords words
  kOthers = 0xE,
  kContinued = 0xF,
};

inline constexpr uint32_t kImuWords = 6;
inline constexpr int kTimeLowBits = 6;
inline constexpr int kTimeHighBits = 28;
inline constexpr uint32_t kCoordinateMask = 0x7FF;

using TimeHigh = HighCounter<kTimeHighBits>;

}  // namespace scarf::evt2
