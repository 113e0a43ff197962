// Push constants of the encodings, shared by the shaders and the host.
#ifndef SCARF_SHADERS_ENCODE_LAYOUT_H
#define SCARF_SHADERS_ENCODE_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Where the words of the span of time are. Times count from the smallest one that there is, and for the
// smallest time the complement is kept: so all are largest numbers, and begin at 0.
SCARF_CONSTANT kSpanFirstHigh = 0;
SCARF_CONSTANT kSpanLastHigh = 1;
SCARF_CONSTANT kSpanFirstLow = 2;
SCARF_CONSTANT kSpanLastLow = 3;
SCARF_CONSTANT kSpanWords = 4;

// Weights are integers in units of 2^-24.
SCARF_CONSTANT kEncodeWeightBits = 24;
// TORE: microseconds, the last entry of the table.
SCARF_CONSTANT kEncodeToreOldest = 5000000;

// All stages of the encodings.
struct EncodePush {
  uint most_events;   // there are as many as the buffer says, but no more than this
  uint first_events;  // in the first of the two buffers
  uint width;
  uint height;
  uint planes;  // encode_voxel: bins; encode_tore_rank: k
  uint mode;    // encode_span: 0 = high words, 1 = low words; encode_voxel: 1 = planes for each polarity;
                // encode_float: words per sum
  uint values;  // encode_float, encode_decay: of the tensor
  uint begin;   // encode_tore_rank: the part of each list, from its end
  uint end;     // encode_decay: last entry of the table
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
