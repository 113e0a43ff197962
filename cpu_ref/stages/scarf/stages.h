// CPU twins of the shader stages: the same buffers in, the same buffers out, so that a difference between the
// device and the reference can be traced to one stage. Plain loops.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "scarf/core/event.h"
#include "shaders/common/layout.h"

namespace scarf::stages {

/// shaders/scarf/scarf_count.comp: adds the events of each chunk in each class of pixels (see PixelClasses).
void scarf_count(std::span<const Event> events, std::span<const uint32_t> classes,
                 std::span<uint32_t> class_counts, const layout::BatchPush& push);

/// shaders/kernels/running_sums.comp.
void running_sums(std::span<uint32_t> table, const layout::SumPush& push);

/// shaders/scarf/scarf_scan.comp: sums of classes become cursors (chunk-major, push.patches); heads
/// and laps advance.
void scarf_scan(std::span<const uint32_t> sums, std::span<const uint32_t> patch_classes,
                std::span<uint32_t> table, std::span<uint32_t> heads, std::span<uint64_t> laps,
                std::span<uint32_t> painted_heads, const layout::ScanPush& push);

/// shaders/scarf/scarf_prune.comp: for each chunk and first patch of a field, 1 if an event there may have a
/// surviving hit. The twin of place needs no such flags: dead hits are dead without them.
void scarf_prune(std::span<const uint32_t> table, std::span<uint32_t> alive, const layout::PrunePush& push);

/// shaders/scarf/scarf_place.comp: stores the hits that survive the batch, and the positions that paint
/// needs.
void scarf_place(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> table,
                 std::span<uint64_t> slots, std::span<uint8_t> positions, const layout::BatchPush& push);

/// shaders/scarf/scarf_append.comp: stores all hits, and the positions that paint needs; heads advance.
void scarf_append(std::span<const Event> events, std::span<const uint32_t> ranges, std::span<uint32_t> heads,
                  std::span<uint64_t> slots, std::span<uint8_t> positions, const layout::AppendPush& push);

/// shaders/scarf/scarf_settle.comp: laps of the heads join the laps.
void scarf_settle(std::span<uint32_t> heads, std::span<uint64_t> laps, std::span<uint32_t> painted_heads);

/// shaders/scarf/scarf_paint.comp: the pictures of cells whose heads have moved since they were last painted.
void scarf_paint(std::span<const uint8_t> positions, std::span<const uint32_t> heads,
                 std::span<uint32_t> painted_heads, std::span<uint8_t> picture,
                 const layout::PaintPush& push);

/// shaders/scarf/scarf_render.comp: adds the active events of slots push.slot_begin .. push.slot_end - 1.
void scarf_render(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                  std::span<const uint64_t> laps, std::span<int32_t> counts, const layout::PatchPush& push);

/// shaders/scarf_tone_u8.comp and scarf_tone_float.comp: `levels` of the counts.
template <class Level>
void scarf_tone(std::span<const int32_t> counts, std::span<const Level> levels, std::span<Level> picture) {
  for (size_t pixel = 0; pixel < picture.size(); ++pixel) picture[pixel] = levels[counts[pixel]];
}

/// shaders/scarf/scarf_extract_count.comp: events to hand out per patch of push.
void scarf_extract_count(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                         std::span<const uint64_t> laps, std::span<uint32_t> cursors,
                         const layout::PatchPush& push);
/// shaders/scarf/scarf_extract_scan.comp: exclusive sums of the counts; returns the sum of all.
uint32_t scarf_extract_scan(std::span<uint32_t> cursors);
/// shaders/scarf/scarf_extract_write.comp: the events, oldest to newest per patch.
void scarf_extract_write(std::span<const uint64_t> slots, std::span<const uint32_t> heads,
                         std::span<const uint64_t> laps, std::span<uint32_t> cursors, std::span<Event> out,
                         const layout::PatchPush& push);

}  // namespace scarf::stages
