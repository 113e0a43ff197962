// EVT3: Prophesee's format of 16-bit words, each with its type in the upper four bits; what a word does not
// say (row, time, base of a vector) is what earlier words said. Source: Prophesee, "EVT 3.0 Format".
#pragma once

#include <cstdint>

#include "io/evt/high_counter.h"

namespace scarf::evt3 {

enum Type : uint32_t {
  kAddrY = 0x0,       // y b10..0; bit 11 tells master from slave cameras
  kOtherAddrY = 0x1,  // row of events that are not brightness changes, until the next kAddrY
  kAddrX = 0x2,       // x b10..0, polarity b11: one event
  kVectBaseX = 0x3,   // x b10..0, polarity b11 of the vectors that follow
  kVect12 = 0x4,      // an event at base + i for each bit i of b11..0; then the base moves on by 12
  kVect8 = 0x5,       // the same with b7..0 and 8
  kTimeLow = 0x6,     // the time's bits 11..0
  kContinued4 = 0x7,
  kTimeHigh = 0x8,  // the time's bits 23..12
  kTrigger = 0xA,   // input b11..8, value b0
  kImu = 0xD,
  kOthers = 0xE,
  kContinued12 = 0xF,
};

inline constexpr uint32_t kFillerWord = 0x9999;  // sent between packets by some cameras; means nothing
inline constexpr int kTimeLowBits = 12;
inline constexpr int kTimeHighBits = 12;
inline constexpr uint32_t kCoordinateMask = 0x7FF;
inline constexpr uint32_t kTriggerInputMask = 0xF;
inline constexpr uint32_t kPayloadMask = 0xFFF;

using TimeHigh = HighCounter<kTimeHighBits>;

}  // namespace scarf::evt3
