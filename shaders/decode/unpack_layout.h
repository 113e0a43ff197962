// Layout of packed events, shared by the shader, its twin and the packer (src/layout/event_packer.h).
#ifndef SCARF_SHADERS_UNPACK_LAYOUT_H
#define SCARF_SHADERS_UNPACK_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Events of a block; the last one of a submission may have fewer.
SCARF_CONSTANT kPackedBlock = 256;

// A table begins with the words of block 0, then those of block 1, and so on: where its data begins (in words from the
// beginning of the table) times 4, plus its form; the time that its offsets count from, low and high.
SCARF_CONSTANT kPackedTableWords = 3;

// Form 0, 1, 2: a word for each event, which holds x, y, polarity and, above them, the lowest bits of the time's
// offset; then as many further bytes for each event as the form says, the next higher bits.
// Form 3: 16 bytes for each event, as they are in memory.
SCARF_CONSTANT kPackedRaw = 3;

// unpack_events.
struct UnpackPush {
  uint first_block;  // of the submission
  uint events;
  uint x_bits;
  uint y_bits;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
