#include "scarf/pipeline.h"

#include <bit>
#include <cstring>

#include "shaders/layout.h"
#include "shaders/shaders.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;
using vulkan::MemoryUse;

constexpr uint64_t kWord = sizeof(uint32_t);

uint64_t pixels(const Geometry& g) {
  return uint64_t{static_cast<uint32_t>(g.x.size)} * g.y.size;
}
uint64_t ring_slots(const Geometry& g) {
  return static_cast<uint64_t>(g.patches()) * g.capacity;
}

uint32_t low_word(int64_t t) {
  return static_cast<uint32_t>(static_cast<uint64_t>(t));
}
uint32_t high_word(int64_t t) {
  return static_cast<uint32_t>(static_cast<uint64_t>(t) >> 32);
}

template <class T>
Result<void> assign(T& target, Result<T> made) {
  if (!made) return made.error();
  target = std::move(made).value();
  return {};
}

template <class T>
Result<Buffer> host_buffer(const vulkan::Device& device, const char* name, std::span<const T> content) {
  auto buffer = Buffer::create(device, name, content.size_bytes(), MemoryUse::upload);
  if (buffer) std::memcpy(buffer->mapped(), content.data(), content.size_bytes());
  return buffer;
}

}  // namespace

Result<std::unique_ptr<ScarfPipeline>> ScarfPipeline::create(vulkan::Device& device, const Geometry& geometry,
                                                             const Levels& levels, const Plan& plan) {
  std::unique_ptr<ScarfPipeline> p(new ScarfPipeline);
  p->device_ = &device;
  p->geometry_ = geometry;
  p->plan_ = plan;
  if (auto r = p->create_buffers(device, levels); !r) return r.error();
  if (auto r = p->create_kernels(device); !r) return r.error();
  return p;
}

Result<void> ScarfPipeline::create_buffers(vulkan::Device& device, const Levels& levels) {
  const uint64_t patches = plan_.patches;
  const struct {
    Buffer& buffer;
    const char* name;
    uint64_t bytes;
  } wanted[] = {
      {slots_, "the ring buffers (patches x capacity)", ring_slots(geometry_) * 8},
      {table_, "the table of chunks and patches", plan_.table_words() * kWord},
      {alive_, "the table of chunks and surviving events", plan_.table_words() * kWord},
      {heads_, "the ring heads", patches * kWord},
      {totals_, "the totals", patches * 8},
      {counts_, "the count image", pixels(geometry_) * kWord},
      {polarity_counts_, "the count image by polarity (two planes)", 2 * pixels(geometry_) * kWord},
      {picture_, "the image (two planes)", 2 * pixels(geometry_) * kWord},
      {cursors_, "the places of extracted events", patches * kWord},
  };
  for (const auto& w : wanted) {
    if (auto r = assign(w.buffer, Buffer::create(device, w.name, w.bytes, MemoryUse::device)); !r) return r;
  }
  const std::vector<uint32_t> ranges = patch_ranges(geometry_);
  const std::vector<uint32_t> u8(levels.u8.begin(), levels.u8.end());
  for (uint32_t i = 0; i < std::min<size_t>(layout::kPushedLevels, u8.size()); ++i) {
    (i < 4 ? first_levels_.levels_0_to_3 : first_levels_.levels_4_to_7) |= u8[i] << 8 * (i % 4);
  }
  if (auto r = assign(ranges_, host_buffer<uint32_t>(device, "the patch ranges", ranges)); !r) return r;
  if (auto r = assign(levels_u8_, host_buffer<uint32_t>(device, "the 8-bit levels", u8)); !r) return r;
  return assign(levels_float_, host_buffer<float>(device, "the float levels", levels.f32));
}

Result<void> ScarfPipeline::create_kernels(vulkan::Device& device) {
  const uint32_t team[] = {plan_.workgroup_size(), plan_.team_x, plan_.team_y, plan_.lane_columns,
                           plan_.lane_rows};
  const struct {
    Kernel& kernel;
    const char* name;
    std::span<const uint32_t> spirv;
    uint32_t bindings;
    size_t push_bytes;
    std::span<const uint32_t> constants;
  } wanted[] = {
      {count_, "scarf_count", shaders::scarf_count, 3, sizeof(layout::BatchPush), {}},
      {integrate_, "scarf_integrate", shaders::scarf_integrate, 1, sizeof(layout::IntegratePush), {}},
      {scan_, "scarf_scan", shaders::scarf_scan, 3, sizeof(layout::ScanPush), {}},
      {prune_, "scarf_prune", shaders::scarf_prune, 2, sizeof(layout::PrunePush), {}},
      {clear_, "scarf_clear", shaders::scarf_clear, 1, sizeof(layout::ClearPush), {}},
      {place_, "scarf_place", shaders::scarf_place, 6, sizeof(layout::BatchPush), team},
      {render_, "scarf_render", shaders::scarf_render, 3, sizeof(layout::PatchPush), {}},
      {tone_u8_, "scarf_tone_u8", shaders::scarf_tone_u8, 3, sizeof(layout::TonePush), {}},
      {tone_float_, "scarf_tone_float", shaders::scarf_tone_float, 3, sizeof(layout::TonePush), {}},
      {extract_count_, "scarf_extract_count", shaders::scarf_extract_count, 3, sizeof(layout::PatchPush), {}},
      {extract_scan_, "scarf_extract_scan", shaders::scarf_extract_scan, 2, sizeof(layout::PatchPush), {}},
      {extract_write_, "scarf_extract_write", shaders::scarf_extract_write, 6, sizeof(layout::PatchPush), {}},
  };
  for (const auto& w : wanted) {
    const auto push_bytes = static_cast<uint32_t>(w.push_bytes);
    auto kernel = Kernel::create(device, w.name, w.spirv, w.bindings, push_bytes, w.constants,
                                 /*whole_subgroups=*/!w.constants.empty());
    if (auto r = assign(w.kernel, std::move(kernel)); !r) return r;
  }
  const struct {
    BoundKernel& bound;
    const Kernel& kernel;
    std::initializer_list<const Buffer*> buffers;
  } bindings[] = {
      {bound_integrate_, integrate_, {&table_}},
      {bound_scan_, scan_, {&table_, &heads_, &totals_}},
      {bound_prune_, prune_, {&table_, &alive_}},
      {bound_clear_, clear_, {&slots_}},
      {bound_render_, render_, {&slots_, &totals_, &polarity_counts_}},
      {bound_tone_u8_[0], tone_u8_, {&counts_, &levels_u8_, &picture_}},
      {bound_tone_u8_[1], tone_u8_, {&polarity_counts_, &levels_u8_, &picture_}},
      {bound_tone_float_[0], tone_float_, {&counts_, &levels_float_, &picture_}},
      {bound_tone_float_[1], tone_float_, {&polarity_counts_, &levels_float_, &picture_}},
      {bound_extract_count_, extract_count_, {&slots_, &totals_, &cursors_}},
  };
  for (const auto& b : bindings) {
    if (auto r = assign(b.bound, BoundKernel::create(device, b.kernel, b.buffers)); !r) return r;
  }
  return {};
}

Result<PushKernels> ScarfPipeline::bind_events(const Buffer& events) const {
  PushKernels k;
  if (auto r = assign(k.count, BoundKernel::create(*device_, count_, {&events, &ranges_, &table_})); !r)
    return r.error();
  if (auto r = assign(k.place, BoundKernel::create(*device_, place_,
                                                   {&events, &ranges_, &table_, &slots_, &alive_, &counts_}));
      !r) {
    return r.error();
  }
  return k;
}

uint64_t ScarfPipeline::half_events() const {
  return (ring_slots(geometry_) + 1) / 2;
}

Result<std::unique_ptr<ExtractTarget>> ScarfPipeline::make_extract_target() const {
  auto t = std::make_unique<ExtractTarget>();
  const auto readback = [&](Buffer& buffer, uint64_t bytes) {
    return assign(buffer, Buffer::create(*device_, "the extracted events", bytes, MemoryUse::readback));
  };
  if (auto r = readback(t->total, kWord); !r) return r.error();
  if (auto r = readback(t->first, half_events() * sizeof(Event)); !r) return r.error();
  if (auto r = readback(t->second, half_events() * sizeof(Event)); !r) return r.error();
  if (auto r = assign(t->scan, BoundKernel::create(*device_, extract_scan_, {&cursors_, &t->total})); !r)
    return r.error();
  auto write = BoundKernel::create(*device_, extract_write_,
                                   {&slots_, &totals_, &heads_, &cursors_, &t->first, &t->second});
  if (auto r = assign(t->write, std::move(write)); !r) return r.error();
  return t;
}

void ScarfPipeline::record_reset(Commands& commands) const {
  commands.fill(heads_, 0);
  commands.fill(totals_, 0);
  commands.fill(counts_, 0);
  const layout::ClearPush push = {static_cast<uint32_t>(ring_slots(geometry_))};
  commands.dispatch(bound_clear_, push.slots, layout::kLinearGroup, push);
  commands.mark("reset");
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
  push.grid_x = geometry_.x.grid;
  push.patches = plan_.patches;
  push.count_corners = plan_.count_corners ? 1 : 0;
  push.prune = chunking.prune ? 1 : 0;
  push.field_x = geometry_.x.field_begin(0);
  push.field_y = geometry_.y.field_begin(0);
  push.margin_lo_x = geometry_.x.margin_lo;
  push.margin_lo_y = geometry_.y.margin_lo;
  push.cell_x = geometry_.x.cell;
  push.cell_y = geometry_.y.cell;
  push.capacity = geometry_.capacity;
  push.t_first_low = low_word(t_first);
  push.t_first_high = high_word(t_first);
  return push;
}

void ScarfPipeline::record_count(Commands& commands, const PushKernels& kernels,
                                 const layout::BatchPush& push) const {
  commands.fill(table_, uint64_t{push.chunks} * plan_.patches * kWord, 0);
  commands.barrier();
  commands.mark("clear");
  commands.dispatch(kernels.count, push.events, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("count");
  if (push.count_corners == 0) return;
  const uint32_t grid_y = push.patches / push.grid_x;
  const layout::IntegratePush rows = {push.patches, push.chunks, grid_y, push.grid_x, push.grid_x, 1};
  const layout::IntegratePush columns = {push.patches, push.chunks, push.grid_x, 1, grid_y, push.grid_x};
  for (const layout::IntegratePush& lines : {rows, columns}) {
    commands.dispatch(bound_integrate_, uint64_t{lines.chunks} * lines.lines, layout::kLinearGroup, lines);
    commands.barrier();
  }
  commands.mark("integrate");
}

void ScarfPipeline::record_scan(Commands& commands, const layout::BatchPush& push) const {
  const layout::ScanPush scan = {push.patches, push.chunks, push.capacity};
  commands.dispatch(bound_scan_, plan_.patches, layout::kLinearGroup, scan);
  commands.barrier();
  commands.mark("scan");
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
  commands.dispatch(kernels.place, uint64_t{push.chunks} * plan_.team_lanes(), plan_.workgroup_size(), push);
  commands.barrier();
  commands.mark("place");
}

void ScarfPipeline::record_push(Commands& commands, const PushKernels& kernels, uint32_t first,
                                uint32_t count, int64_t t_first) const {
  const layout::BatchPush push = batch_push(first, count, t_first);
  record_count(commands, kernels, push);
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

const Buffer& ScarfPipeline::record_counts(Commands& commands, PolarityMode mode) const {
  if (mode == PolarityMode::merged) return counts_;
  layout::PatchPush push = patch_push(0, plan_.patches);
  push.mode = mode == PolarityMode::separate ? layout::kModeSeparate : layout::kModeDifference;
  commands.fill(polarity_counts_, 0);
  commands.barrier();
  for (uint32_t begin = 0; begin < push.capacity; begin += layout::kSlotsPerDispatch) {
    push.slot_begin = begin;
    push.slot_end = std::min(begin + layout::kSlotsPerDispatch, push.capacity);
    commands.dispatch(bound_render_, plan_.patches, layout::kLinearGroup, push);
    commands.barrier();
  }
  commands.mark("render");
  return polarity_counts_;
}

const Buffer& ScarfPipeline::record_u8(Commands& commands, PolarityMode mode) const {
  return record_tone(commands, mode, bound_tone_u8_, 4);
}

const Buffer& ScarfPipeline::record_float(Commands& commands, PolarityMode mode) const {
  return record_tone(commands, mode, bound_tone_float_, 1);
}

const Buffer& ScarfPipeline::record_tone(Commands& commands, PolarityMode mode, const BoundKernel (&tone)[2],
                                         uint32_t pixels_per_invocation) const {
  record_counts(commands, mode);
  const bool separate = mode == PolarityMode::separate;
  layout::TonePush push = first_levels_;
  push.pixels = static_cast<uint32_t>((separate ? 2 : 1) * pixels(geometry_));
  const uint32_t invocations = (push.pixels + pixels_per_invocation - 1) / pixels_per_invocation;
  commands.dispatch(tone[separate], invocations, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("tone");
  return picture_;
}

void ScarfPipeline::record_extract(Commands& commands, const ExtractTarget& target, uint32_t first,
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
  commands.dispatch(target.scan, layout::kScanGroup, layout::kScanGroup, push);
  commands.barrier();
  commands.mark("extract_scan");
  in_segments(target.write);
  commands.mark("extract_write");
}

uint64_t ScarfPipeline::memory_bytes() const {
  uint64_t bytes = 0;
  for (const Buffer* b : {&ranges_, &table_, &alive_, &heads_, &totals_, &slots_, &counts_, &levels_u8_,
                          &levels_float_, &picture_, &cursors_}) {
    bytes += b->size();
  }
  return bytes;
}

}  // namespace scarf
