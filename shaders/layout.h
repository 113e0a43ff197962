// Push constants and constants shared by the shaders and the host. Read by both compilers.
#ifndef SCARF_SHADERS_LAYOUT_H
#define SCARF_SHADERS_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace scarf::layout {
using uint = uint32_t;
#define SCARF_CONSTANT inline constexpr uint
#else
#define SCARF_CONSTANT const uint
#endif

// Invocations per workgroup of the kernels that have one invocation per patch, pixel or word.
// 64: at least one whole subgroup on every known device, and small enough to spread few patches over many cores.
SCARF_CONSTANT kLinearGroup = 64;

// Invocations of the single workgroup that turns per-patch counts into offsets.
SCARF_CONSTANT kScanGroup = 256;

// Slots of a ring that one invocation walks in one dispatch; longer rings take several dispatches.
SCARF_CONSTANT kSlotsPerDispatch = 32768;

// A chunk cursor is (hits still to be overwritten) << 16 | (slot of the first surviving hit).
// Chunks have at most 32,768 events and rings at most 65,535 slots, so both halves fit.
SCARF_CONSTANT kMaxChunkEvents = 32768;
SCARF_CONSTANT kCursorSkipOne = 65536;
// The cursor of a chunk none of whose hits on the patch survives.
SCARF_CONSTANT kCursorDead = 0xFFFFFFFFu;

// 8-bit levels in TonePush.
SCARF_CONSTANT kPushedLevels = 8;

// What the render stage counts (PolarityMode); merged counts are kept by the place stage.
SCARF_CONSTANT kModeSeparate = 1;
SCARF_CONSTANT kModeDifference = 2;

// count and place: one batch of events, cut into chunks.
struct BatchPush {
  uint first_event;   // index of the batch's first event in the staging buffer
  uint events;        // events of the batch
  uint chunk_events;  // events per chunk
  uint chunks;
  uint width;         // sensor; the column ranges are ranges[0 .. width], the row ranges ranges[width + 1 ..]
  uint height;
  uint grid_x;
  uint patches;       // words of the table per chunk
  int field_x;        // origin - margin_lo: first pixel of the field of patch 0, may be negative
  int field_y;
  uint margin_lo_x;
  uint margin_lo_y;
  uint cell_x;
  uint cell_y;
  uint capacity;
  uint t_first_low;
  uint t_first_high;
  uint count_corners; // count: 1 = corners of rectangles, to be integrated; 0 = hits
  uint prune;         // place: 1 = the prune stage has run
};

// clear: the slots of all rings.
struct ClearPush {
  uint slots;
};

// integrate: running sums along the rows or columns of patches of each chunk.
struct IntegratePush {
  uint patches;
  uint chunks;
  uint lines;         // per chunk
  uint line_stride;   // from one line to the next
  uint line_patches;
  uint patch_stride;  // from one patch of a line to the next
};

// prune: which events of a chunk have a surviving hit.
struct PrunePush {
  uint patches;
  uint chunks;
  uint grid_x;
  uint most_columns;  // most patches per axis that hold one pixel
  uint most_rows;
};

// scan: per-chunk hit counts of a patch to cursors.
struct ScanPush {
  uint patches;
  uint chunks;
  uint capacity;
};

// render and extract: patches of the state.
struct PatchPush {
  uint first_patch;
  uint patches;       // from first_patch on
  uint grid_x;
  uint capacity;
  int field_x;
  int field_y;
  uint margin_lo_x;
  uint margin_lo_y;
  uint cell_x;
  uint cell_y;
  uint width;
  uint height;
  uint slot_begin;    // ring slots (render) or ranks from the oldest (extract) of this dispatch
  uint slot_end;
  uint mode;          // render: kMode...; extract: 1 = active events only
  uint half_events;   // extract: events that the first half of the output holds
  uint t_first_low;
  uint t_first_high;
};

// tone: whole numbers to brightness.
struct TonePush {
  uint pixels;
  uint last_level;     // larger numbers count as this one
  uint levels_0_to_3;  // 8-bit levels of 0 .. 7, the first in the lowest bits
  uint levels_4_to_7;
};

// ceiling_*: measurements of a device.
struct CeilingPush {
  uint invocations;
  uint address_bits;  // atomic: the table has 1 << address_bits words, at most 1 << 31
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#undef SCARF_CONSTANT
#endif
