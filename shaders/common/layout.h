// Push constants and constants shared by the shaders and the host. Read by both compilers.
// Shaders copy their push constants to a variable, `push`, once: llvmpipe loads them anew, and slowly, at every use.
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

// One more lap of a ring's head; see ring_head.glsl.
SCARF_CONSTANT kHeadLap = 65536;
// No head: of a patch that is to be painted wherever its head is.
SCARF_CONSTANT kNeverPainted = 0xFFFFFFFFu;

// 8-bit levels in TonePush.
SCARF_CONSTANT kPushedLevels = 8;

// What the render stage counts (PolarityMode).
SCARF_CONSTANT kModeMerged = 0;
SCARF_CONSTANT kModeSeparate = 1;
SCARF_CONSTANT kModeDifference = 2;

// Where the pixel of an active event lies in the picture of its cell, whose rows take whole words, one byte per slot.
// 255: the slot holds no active event. So a cell that is painted has at most 63 words.
SCARF_CONSTANT kPaintWords = 63;
SCARF_CONSTANT kNotShown = 255;
SCARF_CONSTANT kSlotsPerGroup = 16;  // the positions of a ring begin at a multiple

// count and place: one batch of events, cut into chunks.
struct BatchPush {
  uint first_event;    // index of the batch's first event in the staging buffer
  uint events;         // events of the batch
  uint chunk_events;   // events per chunk
  uint chunks;
  uint width;          // sensor; columns are entries 0 .. width of ranges and classes, rows those from width + 1 on
  uint height;
  uint class_columns;  // count: classes of columns, class 0 included
  uint class_words;    // count: words per chunk
  uint grid_x;         // place: from here on
  uint patches;        // words of the table per chunk
  int field_x;         // origin - margin_lo: first pixel of the field of patch 0, may be negative
  int field_y;
  uint cell_x;
  uint cell_y;
  uint capacity;
  uint t_first_low;
  uint t_first_high;
  uint prune;          // 1 = the prune stage has run
  uint stripes;        // see team.glsl
  uint unused_entry;   // index of entries of the table, one per invocation, for what is not to happen
  uint unused_slot;    // slots likewise
  uint margin_lo_x;
  uint margin_lo_y;
  uint row_bytes;      // of positions, per row of a cell; see kNotShown
  uint ring_bytes;     // of positions, per patch
  uint unused_position;
  uint bands;          // see team.glsl
  uint band_rows;      // of patches
};

// append: one batch of events.
struct AppendPush {
  uint first_event;    // index of the batch's first event in the staging buffer
  uint events;         // events of this dispatch
  uint width;          // sensor
  uint height;
  uint grid_x;
  uint grid_y;
  int field_x;         // origin - margin_lo: first pixel of the field of patch 0, may be negative
  int field_y;
  uint cell_x;
  uint cell_y;
  uint overlap_x;      // margin_lo + margin_hi: what a field has more than its cell
  uint overlap_y;
  uint inverse_x;      // of the cell; see divide() in scarf_append.comp
  uint inverse_y;
  uint capacity;
  uint t_first_low;
  uint t_first_high;
  uint parts_shift;    // 1 << parts_shift are the parts of the patches; see scarf_append.comp
  uint bands;
  uint band_rows;      // of a part
  uint unused_slot;    // index of slots, one per invocation, for what is not to happen
  uint margin_lo_x;
  uint margin_lo_y;
  uint row_bytes;      // of positions, per row of a cell; see kNotShown
  uint ring_bytes;     // of positions, per patch
  uint unused_position;
};

// settle: laps of all rings.
struct SettlePush {
  uint patches;
};

// clear: the slots of all rings.
struct ClearPush {
  uint slots;
};

// running_sums: along the lines of each chunk's part of a table.
struct SumPush {
  uint chunks;
  uint chunk_words;
  uint lines;          // per chunk
  uint line_stride;    // from one line to the next
  uint entries;        // of a line
  uint entry_stride;   // from one entry of a line to the next
};

// prune: which events of a chunk have a surviving hit.
struct PrunePush {
  uint patches;
  uint chunks;
  uint grid_x;
  uint most_columns;  // most patches per axis that hold one pixel
  uint most_rows;
};

// scan: sums of a patch's classes per chunk to cursors.
struct ScanPush {
  uint patches;
  uint chunks;
  uint capacity;
  uint grid_x;
  uint class_columns;
  uint class_words;
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

// paint: positions to the picture.
struct PaintPush {
  uint patches;
  uint grid_x;
  uint groups;        // of positions per patch
  int cell_begin_x;   // first pixel of the cell of patch 0
  int cell_begin_y;
  uint cell_x;
  uint cell_y;
  uint row_words;     // per row of a cell
  uint width;
  uint height;
  uint levels_0_to_3; // see TonePush
  uint levels_4_to_7;
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
