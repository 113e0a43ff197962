// Constants and push constants of the prefix sum, shared by the shaders and the host.
#ifndef SCARF_SHADERS_SCAN_LAYOUT_H
#define SCARF_SHADERS_SCAN_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// A workgroup sums one block: each of its lanes takes a run of words. Lanes are in rows, so that a lane has
// to look at the sums of the rows before its own and of the lanes before it only.
SCARF_CONSTANT kPrefixGroup = 256;
SCARF_CONSTANT kPrefixRow = 16;
SCARF_CONSTANT kPrefixRun = 16;
SCARF_CONSTANT kPrefixBlock = kPrefixGroup * kPrefixRun;

// scan_sum, scan_block.
struct PrefixPush {
  uint words;
  uint has_offsets;  // scan_block: 1 = each block begins at its offset, 0 = at 0
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
