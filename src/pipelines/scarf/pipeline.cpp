#include "pipelines/scarf/pipeline.h"

#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"
#include "layout/ring_head.h"
#include "layout/words.h"
#include "pipelines/scarf/pixel_classes.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::View;

constexpr uint64_t kWord = sizeof(uint32_t);

uint64_t ring_slots(const Geometry& g) {
  return static_cast<uint64_t>(g.patches()) * g.capacity;
}

}  // namespace

Result<std::unique_ptr<ScarfPipeline>> ScarfPipeline::create(vulkan::Device& device, const Geometry& geometry,
                                                             const Levels& levels, const Plan& plan) {
  std::unique_ptr<ScarfPipeline> p(new ScarfPipeline(device, geometry, plan));
  PipelineBuilder builder(device);
  p->build(builder, levels);
  if (!builder.result()) return builder.result().error();
  p->bytes_ = builder.bytes();
  return p;
}

void ScarfPipeline::build(PipelineBuilder& b, const Levels& levels) {
  const uint64_t patches = plan_.patches;
  const uint64_t plane = pixels(PolarityMode::merged);
  const uint64_t unused = plan_.most_invocations();
  b.buffer(slots_, "the ring buffers (patches x capacity)", (ring_slots(geometry_) + unused) * 8);
  b.buffer(class_counts_, "the table of chunks and classes of pixels",
           uint64_t{plan_.max_chunks} * plan_.class_words() * kWord);
  b.buffer(table_, "the table of chunks and patches", (plan_.table_words() + unused) * kWord);
  b.buffer(alive_, "the table of chunks and surviving events", plan_.table_words() * kWord);
  b.buffer(heads_, "the ring heads", (patches + plan_.append.invocations()) * kWord);
  b.buffer(laps_, "the laps of the rings", patches * sizeof(uint64_t));
  b.buffer(painted_heads_, "the ring heads when the patches were painted", patches * kWord);
  b.buffer(counts_, "the count image (two planes)", 2 * plane * kWord);
  // One byte behind the pictures's pixels takes those of cells that are not on the sensor.
  b.buffer(painted_, "the 8-bit picture", plane / 4 * 4 + 4);
  b.buffer(positions_, "the positions of active events", position_bytes() + 8 * unused);
  b.buffer(cursors_, "the places of extracted events", patches * kWord);
  b.table<uint32_t>(ranges_, "the patch ranges", patch_ranges(geometry_));
  PixelClasses columns = pixel_classes(geometry_.x);
  PixelClasses rows = pixel_classes(geometry_.y);
  columns.of_pixel.insert(columns.of_pixel.end(), rows.of_pixel.begin(), rows.of_pixel.end());
  columns.of_patch.insert(columns.of_patch.end(), rows.of_patch.begin(), rows.of_patch.end());
  b.table<uint32_t>(pixel_classes_, "the classes of pixels", columns.of_pixel);
  b.table<uint32_t>(patch_classes_, "the classes of patches", columns.of_patch);
  tone_.build(b, levels, 2 * plane);

  const uint32_t team[] = {plan_.workgroup_size(), plan_.team_x,    plan_.team_y,
                           plan_.lane_columns,     plan_.lane_rows, plan_.paints ? 1U : 0U};
  const AppendPlan& a = plan_.append;
  const uint32_t appending[] = {
      a.lanes, a.team_x, a.team_y, a.lane_columns, a.lane_rows, plan_.paints ? 1U : 0U, a.teams};
  b.kernel(count_, "scarf_count", shaders::scarf_count, {View::vectors, View::words, View::storage},
           sizeof(layout::BatchPush));
  b.kernel(sum_, "running_sums", shaders::running_sums, {View::image}, sizeof(layout::SumPush));
  b.kernel(scan_, "scarf_scan", shaders::scarf_scan,
           {View::words, View::storage, View::storage, View::storage, View::storage, View::storage},
           sizeof(layout::ScanPush));
  b.kernel(prune_, "scarf_prune", shaders::scarf_prune, {View::words, View::storage},
           sizeof(layout::PrunePush));
  b.kernel(settle_, "scarf_settle", shaders::scarf_settle, 3, sizeof(layout::SettlePush));
  b.kernel(clear_, "scarf_clear", shaders::scarf_clear, 1, sizeof(layout::ClearPush));
  b.kernel(place_, "scarf_place", shaders::scarf_place,
           {View::vectors, View::words, View::image, View::storage, View::words, View::storage},
           sizeof(layout::BatchPush), team,
           /*whole_subgroups=*/true);
  b.kernel(append_, "scarf_append", shaders::scarf_append,
           {View::vectors, View::image, View::storage, View::storage}, sizeof(layout::AppendPush), appending,
           /*whole_subgroups=*/true);
  b.kernel(render_, "scarf_render", shaders::scarf_render, 4, sizeof(layout::PatchPush));
  b.kernel(paint_, "scarf_paint", shaders::scarf_paint,
           {View::vectors, View::storage, View::storage, View::storage}, sizeof(layout::PaintPush));
  b.kernel(extract_count_, "scarf_extract_count", shaders::scarf_extract_count, 4, sizeof(layout::PatchPush));
  b.kernel(extract_scan_, "scarf_extract_scan", shaders::scarf_extract_scan, 2, sizeof(layout::PatchPush));
  b.kernel(extract_write_, "scarf_extract_write", shaders::scarf_extract_write, 6, sizeof(layout::PatchPush));

  b.bind(bound_sum_, sum_, {&class_counts_});
  b.bind(bound_scan_, scan_, {&class_counts_, &patch_classes_, &table_, &heads_, &laps_, &painted_heads_});
  b.bind(bound_prune_, prune_, {&table_, &alive_});
  b.bind(bound_settle_, settle_, {&heads_, &laps_, &painted_heads_});
  b.bind(bound_clear_, clear_, {&slots_});
  b.bind(bound_render_, render_, {&slots_, &heads_, &laps_, &counts_});
  b.bind(bound_paint_, paint_, {&positions_, &heads_, &painted_heads_, &painted_});
  b.bind(bound_extract_count_, extract_count_, {&slots_, &heads_, &laps_, &cursors_});
  tone_.bind(b, bound_tone_, counts_);
}

Result<std::unique_ptr<EventBinding>> ScarfPipeline::bind_events(const Buffer& events) {
  auto k = std::make_unique<PushKernels>();
  PipelineBuilder b(device_);
  b.bind(k->count, count_, {&events, &pixel_classes_, &class_counts_});
  b.bind(k->place, place_, {&events, &ranges_, &table_, &slots_, &alive_, &positions_});
  b.bind(k->append, append_, {&events, &heads_, &slots_, &positions_});
  if (!b.result()) return b.result().error();
  return std::unique_ptr<EventBinding>(std::move(k));
}

uint64_t ScarfPipeline::position_bytes() const {
  return plan_.paints ? uint64_t{plan_.patches} * plan_.position_groups * layout::kSlotsPerGroup : 0;
}

uint64_t ScarfPipeline::half_events() const {
  return (ring_slots(geometry_) + 1) / 2;
}

Result<std::unique_ptr<ExtractMemory>> ScarfPipeline::make_extract_memory() const {
  auto t = std::make_unique<ExtractMemory>();
  PipelineBuilder b(device_);
  b.readback(t->total, "the number of extracted events", kWord);
  b.readback(t->first, "the extracted events", half_events() * sizeof(Event));
  b.readback(t->second, "the extracted events", half_events() * sizeof(Event));
  b.bind(t->scan, extract_scan_, {&cursors_, &t->total});
  b.bind(t->write, extract_write_, {&slots_, &heads_, &laps_, &cursors_, &t->first, &t->second});
  if (!b.result()) return b.result().error();
  return t;
}

void ScarfPipeline::record_reset(Commands& commands) {
  commands.fill(heads_, 0);
  commands.fill(laps_, 0);
  commands.fill(painted_heads_, 0);
  commands.fill(painted_, 0);
  commands.fill(positions_, UINT32_MAX);
  commands.fill(table_, layout::kCursorDead);  // for the entries behind those of chunks
  const layout::ClearPush push = {static_cast<uint32_t>(ring_slots(geometry_))};
  commands.dispatch(bound_clear_, push.slots, layout::kLinearGroup, push);
  commands.mark("reset");
  unsettled_laps_ = 0;
}

layout::BatchPush ScarfPipeline::batch_push(uint32_t first, uint32_t count, int64_t t_first) const {
  const Chunking chunking = plan_.cut(count);
  layout::BatchPush push{};
  push.first_event = first;
  push.events = count;
  push.chunk_events = chunking.chunk_events;
  push.chunks = chunking.chunks;
  push.width = geometry_.x.size;
  push.height = geometry_.y.size;
  push.class_columns = plan_.class_columns;
  push.class_words = plan_.class_words();
  push.grid_x = geometry_.x.grid;
  push.patches = plan_.patches;
  push.field_x = geometry_.x.field_begin(0);
  push.field_y = geometry_.y.field_begin(0);
  push.cell_x = geometry_.x.cell;
  push.cell_y = geometry_.y.cell;
  push.capacity = geometry_.capacity;
  push.prune = chunking.prune ? 1 : 0;
  push.stripes = chunking.stripes;
  push.bands = plan_.bands;
  push.band_rows = plan_.band_rows;
  push.unused_entry = static_cast<uint32_t>(plan_.table_words());
  push.unused_slot = static_cast<uint32_t>(ring_slots(geometry_));
  push.margin_lo_x = geometry_.x.margin_lo;
  push.margin_lo_y = geometry_.y.margin_lo;
  push.row_bytes = 4 * plan_.cell_row_words;
  push.ring_bytes = layout::kSlotsPerGroup * plan_.position_groups;
  push.unused_position = static_cast<uint32_t>(position_bytes());
  push.t_first_low = low_word(t_first);
  push.t_first_high = high_word(t_first);
  return push;
}

void ScarfPipeline::record_count(Commands& commands, const PushKernels& kernels,
                                 const layout::BatchPush& push) const {
  commands.fill(class_counts_, uint64_t{push.chunks} * push.class_words * kWord, 0);
  commands.barrier();
  commands.mark("clear");
  commands.dispatch(kernels.count, push.events, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("count");
}

void ScarfPipeline::record_sum(Commands& commands, const layout::BatchPush& push) const {
  const uint32_t columns = plan_.class_columns;
  const uint32_t rows = plan_.class_rows;
  const layout::SumPush along_rows = {push.chunks, push.class_words, rows, columns, columns, 1};
  const layout::SumPush along_columns = {push.chunks, push.class_words, columns, 1, rows, columns};
  for (const layout::SumPush& lines : {along_rows, along_columns}) {
    commands.dispatch(bound_sum_, uint64_t{lines.chunks} * lines.lines, layout::kLinearGroup, lines);
    commands.barrier();
  }
  commands.mark("sum");
}

void ScarfPipeline::record_scan(Commands& commands, const layout::BatchPush& push) {
  const layout::ScanPush scan = {push.patches, push.chunks,        push.capacity,
                                 push.grid_x,  push.class_columns, push.class_words};
  commands.dispatch(bound_scan_, plan_.patches, layout::kLinearGroup, scan);
  commands.barrier();
  commands.mark("scan");
  unsettled_laps_ = 0;
}

void ScarfPipeline::record_prune(Commands& commands, const layout::BatchPush& push) const {
  if (push.prune == 0) return;
  const layout::PrunePush prune = {push.patches, push.chunks, push.grid_x, plan_.most_columns,
                                   plan_.most_rows};
  commands.dispatch(bound_prune_, uint64_t{push.chunks} * push.patches, layout::kLinearGroup, prune);
  commands.barrier();
  commands.mark("prune");
}

void ScarfPipeline::record_place(Commands& commands, const PushKernels& kernels,
                                 const layout::BatchPush& push) const {
  commands.dispatch(kernels.place, plan_.teams(push.chunks, push.stripes) * plan_.team_lanes(),
                    plan_.workgroup_size(), push);
  commands.barrier();
  commands.mark("place");
}

layout::AppendPush ScarfPipeline::append_push(uint32_t first, uint32_t count, int64_t t_first) const {
  const GridAxis& x = geometry_.x;
  const GridAxis& y = geometry_.y;
  const auto inverse = [](int32_t cell) { return ceil_div(uint32_t{1} << 31, static_cast<uint32_t>(cell)); };
  layout::AppendPush push{};
  push.first_event = first;
  push.events = count;
  push.width = x.size;
  push.height = y.size;
  push.grid_x = x.grid;
  push.grid_y = y.grid;
  push.field_x = x.field_begin(0);
  push.field_y = y.field_begin(0);
  push.cell_x = x.cell;
  push.cell_y = y.cell;
  push.overlap_x = x.margin_lo + x.margin_hi;
  push.overlap_y = y.margin_lo + y.margin_hi;
  push.inverse_x = inverse(x.cell);
  push.inverse_y = inverse(y.cell);
  push.capacity = geometry_.capacity;
  push.t_first_low = low_word(t_first);
  push.t_first_high = high_word(t_first);
  push.parts_shift = plan_.append.parts_shift;
  push.bands = plan_.append.bands;
  push.band_rows = plan_.append.band_rows;
  push.unused_slot = static_cast<uint32_t>(ring_slots(geometry_));
  push.margin_lo_x = x.margin_lo;
  push.margin_lo_y = y.margin_lo;
  push.row_bytes = 4 * plan_.cell_row_words;
  push.ring_bytes = layout::kSlotsPerGroup * plan_.position_groups;
  push.unused_position = static_cast<uint32_t>(position_bytes());
  return push;
}

void ScarfPipeline::record_settle(Commands& commands) {
  const layout::SettlePush push = {plan_.patches};
  commands.dispatch(bound_settle_, plan_.patches, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("settle");
  unsettled_laps_ = 0;
}

void ScarfPipeline::count_laps(Commands& commands, uint32_t events) {
  const uint64_t most = ceil_div(events, static_cast<uint32_t>(geometry_.capacity));
  if (unsettled_laps_ + most > kMostHeadLaps) record_settle(commands);
  unsettled_laps_ += most;
}

void ScarfPipeline::record_append(Commands& commands, const PushKernels& kernels,
                                  const layout::AppendPush& push) {
  layout::AppendPush segment = push;
  for (uint32_t begin = 0; begin < push.events; begin += plan_.append.dispatch_events) {
    segment.first_event = push.first_event + begin;
    segment.events = std::min(plan_.append.dispatch_events, push.events - begin);
    count_laps(commands, segment.events);
    commands.dispatch(kernels.append, plan_.append.invocations(), plan_.append.lanes, segment);
    commands.barrier();
  }
  commands.mark("append");
}

void ScarfPipeline::record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                                const StreamFacts& facts) {
  const auto& kernels = static_cast<const PushKernels&>(binding);
  if (plan_.appended(count)) {
    record_append(commands, kernels, append_push(first, count, facts.first.value_or(0)));
    return;
  }
  const layout::BatchPush push = batch_push(first, count, facts.first.value_or(0));
  record_count(commands, kernels, push);
  record_sum(commands, push);
  record_scan(commands, push);
  record_prune(commands, push);
  record_place(commands, kernels, push);
}

layout::PatchPush ScarfPipeline::patch_push(uint32_t first, uint32_t count) const {
  const Geometry& g = geometry_;
  layout::PatchPush push{};
  push.first_patch = first;
  push.patches = count;
  push.grid_x = g.x.grid;
  push.capacity = g.capacity;
  push.field_x = g.x.field_begin(0);
  push.field_y = g.y.field_begin(0);
  push.margin_lo_x = g.x.margin_lo;
  push.margin_lo_y = g.y.margin_lo;
  push.cell_x = g.x.cell;
  push.cell_y = g.y.cell;
  push.width = g.x.size;
  push.height = g.y.size;
  return push;
}

layout::PaintPush ScarfPipeline::paint_push() const {
  const GridAxis& x = geometry_.x;
  const GridAxis& y = geometry_.y;
  layout::PaintPush push{};
  push.patches = plan_.patches;
  push.grid_x = x.grid;
  push.groups = plan_.position_groups;
  push.cell_begin_x = x.origin;
  push.cell_begin_y = y.origin;
  push.cell_x = x.cell;
  push.cell_y = y.cell;
  push.row_words = plan_.cell_row_words;
  push.width = x.size;
  push.height = y.size;
  push.levels_0_to_3 = tone_.first_levels().levels_0_to_3;
  push.levels_4_to_7 = tone_.first_levels().levels_4_to_7;
  return push;
}

const Buffer& ScarfPipeline::record_counts(Commands& commands, PolarityMode mode) const {
  layout::PatchPush push = patch_push(0, plan_.patches);
  push.mode = mode == PolarityMode::separate     ? layout::kModeSeparate
              : mode == PolarityMode::difference ? layout::kModeDifference
                                                 : layout::kModeMerged;
  commands.fill(counts_, pixels(mode) * kWord, 0);
  commands.barrier();
  for (uint32_t begin = 0; begin < push.capacity; begin += layout::kSlotsPerDispatch) {
    push.slot_begin = begin;
    push.slot_end = std::min(begin + layout::kSlotsPerDispatch, push.capacity);
    commands.dispatch(bound_render_, plan_.patches, layout::kLinearGroup, push);
    commands.barrier();
  }
  commands.mark("render");
  return counts_;
}

uint64_t ScarfPipeline::pixels(PolarityMode mode) const {
  const uint64_t planes = mode == PolarityMode::separate ? 2 : 1;
  return planes * geometry_.x.size * geometry_.y.size;
}

const Buffer& ScarfPipeline::record_u8(Commands& commands, PolarityMode mode) const {
  if (mode == PolarityMode::merged && plan_.paints) {
    const layout::PaintPush push = paint_push();
    commands.dispatch(bound_paint_, plan_.patches, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("paint");
    return painted_;
  }
  record_counts(commands, mode);
  tone_.record_u8(commands, bound_tone_, pixels(mode));
  return picture();
}

const Buffer& ScarfPipeline::record_float(Commands& commands, PolarityMode mode) const {
  record_counts(commands, mode);
  tone_.record_float(commands, bound_tone_, pixels(mode));
  return picture();
}

void ScarfPipeline::record_extract(Commands& commands, const ExtractMemory& memory, uint32_t first,
                                   uint32_t count, bool active_only, int64_t t_first) const {
  layout::PatchPush push = patch_push(first, count);
  push.mode = active_only ? 1 : 0;
  push.half_events = static_cast<uint32_t>(half_events());
  push.t_first_low = low_word(t_first);
  push.t_first_high = high_word(t_first);
  const auto in_segments = [&](const BoundKernel& kernel) {
    for (uint32_t begin = 0; begin < push.capacity; begin += layout::kSlotsPerDispatch) {
      push.slot_begin = begin;
      push.slot_end = std::min(begin + layout::kSlotsPerDispatch, push.capacity);
      commands.dispatch(kernel, count, layout::kLinearGroup, push);
      commands.barrier();
    }
  };
  in_segments(bound_extract_count_);
  commands.mark("extract_count");
  commands.dispatch(memory.scan, layout::kScanGroup, layout::kScanGroup, push);
  commands.barrier();
  commands.mark("extract_scan");
  in_segments(memory.write);
  commands.mark("extract_write");
}

}  // namespace scarf
