// Constants, push constants and structures of the decoding of camera words, shared by the shaders, their twins and the
// host.
#ifndef SCARF_SHADERS_DECODE_LAYOUT_H
#define SCARF_SHADERS_DECODE_LAYOUT_H
#ifndef __cplusplus
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

SCARF_CONSTANT kDecodeEvt2 = 2;
SCARF_CONSTANT kDecodeEvt3 = 3;

// A lane walks a run of words, a workgroup a block of runs. 128 lanes: their facts fit the 16 KiB of shared memory that
// every device has. Lanes are in rows, so that prefixes over them take few steps.
SCARF_CONSTANT kDecodeGroup = 128;
SCARF_CONSTANT kDecodeRow = 16;
SCARF_CONSTANT kDecodeRun = 32;
SCARF_CONSTANT kDecodeBlock = kDecodeGroup * kDecodeRun;

// Of `first` and `last`: the words hold no TIME_HIGH.
SCARF_CONSTANT kDecodeNone = 0xFFFFFFFFu;

// Bits of DecodeSummary::low: TIME_LOW before the first TIME_HIGH of the words, and behind it, each with its mark.
SCARF_CONSTANT kDecodeLowSet = 0x1000u;
SCARF_CONSTANT kDecodeLowShift = 16;
// Bits of DecodeSummary::row: the row (b10..0), whether it is of events other than brightness changes; with marks.
SCARF_CONSTANT kDecodeRowSet = 0x1000u;
SCARF_CONSTANT kDecodeOther = 0x2000u;
SCARF_CONSTANT kDecodeOtherSet = 0x4000u;
// Bits of DecodeSummary::base: where the vector base is, or, unmarked, by how much it moves (b15..0); the polarity.
SCARF_CONSTANT kDecodeBasePolarity = 0x10000u;
SCARF_CONSTANT kDecodeBaseSet = 0x20000u;
// Beyond every sensor the vector base stops.
SCARF_CONSTANT kDecodeLastBase = 0xF000;

// Words of an EVT2 IMU block behind its first, and the map that changes nothing: nibble s is what becomes of s words
// still to be skipped.
SCARF_CONSTANT kDecodeImuSkip = 5;
SCARF_CONSTANT kDecodeSkipSame = 0x543210u;
SCARF_CONSTANT kDecodeSkipOnes = 0x111111u;

// What words do to the state of a decoder, whatever it was before. EVT2 uses the first three only.
struct DecodeSummary {
  uint first;  // the first and the last TIME_HIGH, or kDecodeNone
  uint last;
  uint wraps;  // of the clock, from the first to the last
  uint low;
  uint row;
  uint base;
};

// Microseconds: a longer step forward is a jump. As kLongestStep of scarf/core/read_report.h.
SCARF_CONSTANT kDecodeLongestStep = 10000000;

// What a decoder remembers behind the first TIME_HIGH. All 0: before every other word.
struct DecodeState {
  uint loops_low;   // wraps of the clock, 64 bits
  uint loops_high;
  uint time_high;
  uint time_low;
  uint y;
  uint other;       // 1: the row is of events that are not brightness changes
  uint base_x;
  uint base_p;
};

// What is carried from submission to submission.
struct DecodeCarry {
  DecodeState state;
  uint skip;  // words left of an EVT2 IMU block
  uint unused[3];
};

// What the host wants to know of the events of some words. "Inside": on the sensor, hence handed on.
struct DecodeFacts {
  uint inside;
  uint outside;
  uint unknown;     // words that the format does not define
  uint back_steps;  // events older than the event before them
  uint gaps;        // EVT3: steps of TIME_HIGH to other than the next value
  uint jumps;       // steps forward of more than kDecodeLongestStep
  int64_t largest_step;
  int64_t largest_jump;       // 0: none
  int64_t largest_jump_from;  // the time in front of the first one that large
  int64_t first;    // times of any events, in order of arrival; -1: no event
  int64_t last;
  int64_t first_inside;  // the same of events inside; -1: none
  int64_t last_inside;
  int64_t smallest;      // of events inside; the largest possible time if there are none
  int64_t largest;       // -1: none
};

// What the host reads of a submission.
struct DecodeResult {
  DecodeFacts facts;
  uint loops_low;  // wraps of the clock so far, 64 bits
  uint loops_high;
};

// All stages of decoding.
struct DecodePush {
  uint words;
  uint blocks;
  uint width;   // sensor
  uint height;
  uint first_event;  // write: events first_event .. first_event + events - 1 of those inside are written
  uint events;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
