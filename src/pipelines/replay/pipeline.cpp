#include "pipelines/replay/pipeline.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "compiled_shaders/shaders.h"
#include "pipelines/scarf/plan.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::View;

constexpr uint64_t kWord = sizeof(uint32_t);

// Brightness of 0 .. capacity as the frames stage reads it.
std::vector<uint32_t> level_words(ReplayPixels pixels, const Levels& levels) {
  if (pixels == ReplayPixels::u8) return {levels.u8.begin(), levels.u8.end()};
  std::vector<uint32_t> words;
  for (const float level : levels.f32) words.push_back(std::bit_cast<uint32_t>(level));
  return words;
}

const Buffer& shader_side(const Buffer& host, const Buffer& device) {
  return device.size() != 0 ? device : host;
}

}  // namespace

Result<std::unique_ptr<ReplayPipeline>> ReplayPipeline::create(vulkan::Device& device,
                                                               const Geometry& geometry, ReplayPixels pixels,
                                                               const Levels& levels, const ReplayPlan& plan) {
  std::unique_ptr<ReplayPipeline> p(new ReplayPipeline(device, geometry, plan));
  PipelineBuilder builder(device);
  p->build(builder, pixels, levels);
  if (!builder.result()) return builder.result().error();
  p->bytes_ = builder.bytes();
  return p;
}

void ReplayPipeline::build(PipelineBuilder& b, ReplayPixels pixels, const Levels& levels) {
  const uint64_t patches = plan_.patches;
  b.buffer(table_, "the table of chunks and patches", plan_.table_bytes());
  b.buffer(ranks_, "the ranks of events", plan_.group_events * kWord);
  b.buffer(heads_, "the ring heads", patches * 2 * kWord);
  b.buffer(changes_, "the changes of the pictures", plan_.changes_bytes());
  b.buffer(kept_, "the kept slots", patches * plan_.kept_words() * kWord);
  b.buffer(pixels_, "the pixels of the ring buffers (patches x capacity)", patches * plan_.capacity * kWord);
  b.buffer(counts_, "the count image", plan_.change_words() * kWord);
  b.table<uint32_t>(ranges_, "the patch ranges", patch_ranges(geometry_));
  const std::vector<uint32_t> words = level_words(pixels, levels);
  b.table<uint32_t>(levels_, "the levels", words);
  for (uint32_t i = 0; i < layout::kPushedLevels; ++i) {
    const uint32_t level = words[std::min<size_t>(i, words.size() - 1)] & 0xFF;
    (i < 4 ? first_levels_.levels_0_to_3 : first_levels_.levels_4_to_7) |= level << 8 * (i % 4);
  }

  const uint32_t team[] = {plan_.workgroup_size(), plan_.team_x, plan_.team_y, plan_.lane_columns,
                           plan_.lane_rows};
  const size_t push_bytes = sizeof(layout::ReplayPush);
  b.kernel(count_, "replay_count", shaders::replay_count,
           {View::words, View::words, View::storage, View::words}, push_bytes);
  b.kernel(integrate_, "running_sums", shaders::running_sums, {View::image}, sizeof(layout::SumPush));
  b.kernel(scan_, "replay_scan", shaders::replay_scan, {View::words, View::words, View::image, View::storage},
           push_bytes);
  b.kernel(rank_, "replay_rank", shaders::replay_rank,
           {View::words, View::words, View::image, View::words, View::storage}, push_bytes, team,
           /*whole_subgroups=*/true);
  b.kernel(carry_, "replay_carry", shaders::replay_carry,
           {View::words, View::words, View::words, View::words, View::storage, View::storage, View::storage},
           push_bytes);
  b.kernel(change_, "replay_change", shaders::replay_change,
           {View::words, View::words, View::words, View::words, View::storage, View::storage, View::storage,
            View::words},
           push_bytes);
  const uint32_t looked_up = pixels == ReplayPixels::counts ? 0 : 1;
  const uint32_t constants[] = {plan_.count_bits, looked_up};
  const size_t frames_bytes = sizeof(layout::ReplayFramesPush);
  if (pixels == ReplayPixels::u8)
    b.kernel(frames_, "replay_frames_u8", shaders::replay_frames_u8,
             {View::words, View::storage, View::words, View::storage}, frames_bytes,
             std::span(constants).first(1));
  else
    b.kernel(frames_, "replay_frames_wide", shaders::replay_frames_wide,
             {View::words, View::storage, View::words, View::storage}, frames_bytes, constants);
  b.bind(bound_integrate_, integrate_, {&table_});
}

Result<std::unique_ptr<ReplayGroup>> ReplayPipeline::make_group() {
  auto group = std::make_unique<ReplayGroup>();
  ReplayGroup& g = *group;
  PipelineBuilder b(device_);
  const uint64_t events_bytes = plan_.group_events * kWord;
  const uint64_t chunks_bytes = (uint64_t{plan_.max_chunks} + 1) * sizeof(layout::ReplayChunk);
  b.upload(g.events, "the events of a group", events_bytes);
  b.upload(g.chunks, "the chunks of a group", chunks_bytes);
  b.readback(g.pictures, "the pictures of a group", plan_.pictures_bytes());
  if (!b.result()) return b.result().error();
  // Shaders use host memory where that is device memory too.
  const bool forced = device_.options().upload != DeviceOptions::Upload::automatic;
  if (forced || !g.events.device_local()) {
    b.buffer(g.device_events, "the events of a group on the device", events_bytes);
    b.buffer(g.device_chunks, "the chunks of a group on the device", chunks_bytes);
  }
  if (forced || !g.pictures.device_local()) {
    b.buffer(g.device_pictures, "the pictures of a group on the device", plan_.pictures_bytes());
  }
  const Buffer* events = &shader_side(g.events, g.device_events);
  const Buffer* chunks = &shader_side(g.chunks, g.device_chunks);
  const Buffer* pictures = &shader_side(g.pictures, g.device_pictures);
  b.bind(g.count, count_, {events, chunks, &table_, &ranges_});
  b.bind(g.scan, scan_, {events, chunks, &table_, &heads_});
  b.bind(g.rank, rank_, {events, chunks, &table_, &ranges_, &ranks_});
  b.bind(g.carry, carry_, {events, chunks, &table_, &heads_, &changes_, &kept_, &pixels_});
  b.bind(g.change, change_, {events, chunks, &table_, &heads_, &changes_, &kept_, &pixels_, &ranks_});
  b.bind(g.frames, frames_, {&changes_, &counts_, &levels_, pictures});
  if (!b.result()) return b.result().error();
  bytes_ += b.bytes();
  return group;
}

void ReplayPipeline::record_reset(Commands& commands) const {
  commands.fill(heads_, 0);
  commands.fill(kept_, 0);
  commands.fill(counts_, 0);
  commands.barrier();
}

layout::ReplayPush ReplayPipeline::push(uint32_t chunks) const {
  layout::ReplayPush push{};
  push.chunks = chunks;
  push.stride = plan_.stride();
  push.patches = plan_.patches;
  push.width = geometry_.x.size;
  push.height = geometry_.y.size;
  push.grid_x = geometry_.x.grid;
  push.grid_y = geometry_.y.grid;
  push.origin_x = geometry_.x.origin;
  push.origin_y = geometry_.y.origin;
  push.cell_x = geometry_.x.cell;
  push.cell_y = geometry_.y.cell;
  push.capacity = plan_.capacity;
  push.kept_words = plan_.kept_words();
  push.change_words = plan_.change_words();
  push.count_bits = plan_.count_bits;
  return push;
}

layout::ReplayFramesPush ReplayPipeline::frames_push(uint32_t frames) const {
  layout::ReplayFramesPush push = first_levels_;
  push.frames = frames;
  push.invocations = plan_.picture_invocations();
  return push;
}

void ReplayPipeline::record_upload(Commands& commands, const ReplayGroup& group, uint32_t events,
                                   uint32_t chunks) const {
  if (group.device_events.size() == 0) return;
  commands.copy(group.events, 0, group.device_events, 0, events * kWord);
  commands.copy(group.chunks, 0, group.device_chunks, 0,
                (uint64_t{chunks} + 1) * sizeof(layout::ReplayChunk));
  commands.barrier();
  commands.mark("upload");
}

void ReplayPipeline::record_count(Commands& commands, const ReplayGroup& group, uint32_t chunks) const {
  commands.fill(table_, uint64_t{chunks} * plan_.stride() * kWord, 0);
  commands.barrier();
  commands.dispatch(group.count, uint64_t{chunks} * layout::kLinearGroup, layout::kLinearGroup, push(chunks));
  commands.barrier();
  commands.mark("count");
  const auto grid_x = static_cast<uint32_t>(geometry_.x.grid);
  const auto grid_y = static_cast<uint32_t>(geometry_.y.grid);
  const layout::SumPush rows = {chunks, plan_.stride(), grid_y, grid_x, grid_x, 1};
  const layout::SumPush columns = {chunks, plan_.stride(), grid_x, 1, grid_y, grid_x};
  for (const layout::SumPush& lines : {rows, columns}) {
    commands.dispatch(bound_integrate_, uint64_t{chunks} * lines.lines, layout::kLinearGroup, lines);
    commands.barrier();
  }
  commands.mark("integrate");
}

void ReplayPipeline::record_scan(Commands& commands, const ReplayGroup& group, uint32_t chunks) const {
  commands.dispatch(group.scan, plan_.patches, layout::kLinearGroup, push(chunks));
  commands.barrier();
  commands.mark("scan");
}

void ReplayPipeline::record_rank(Commands& commands, const ReplayGroup& group, uint32_t chunks) const {
  commands.dispatch(group.rank, uint64_t{chunks} * plan_.team_lanes(), plan_.workgroup_size(), push(chunks));
  commands.barrier();
  commands.mark("rank");
}

void ReplayPipeline::record_clear(Commands& commands, uint32_t frames) const {
  commands.fill(changes_, (uint64_t{frames} + 1) * plan_.change_words() * kWord, 0);
  commands.barrier();
  commands.mark("clear");
}

void ReplayPipeline::record_carry(Commands& commands, const ReplayGroup& group, uint32_t chunks) const {
  const uint64_t words = uint64_t{plan_.patches} * plan_.kept_words();
  commands.dispatch(group.carry, words, layout::kLinearGroup, push(chunks));
  commands.barrier();
  commands.mark("carry");
}

void ReplayPipeline::record_change(Commands& commands, const ReplayGroup& group, uint32_t chunks) const {
  commands.dispatch(group.change, uint64_t{chunks} * layout::kLinearGroup, layout::kLinearGroup,
                    push(chunks));
  commands.barrier();
  commands.mark("change");
}

void ReplayPipeline::record_frames(Commands& commands, const ReplayGroup& group, uint32_t frames) const {
  commands.dispatch(group.frames, plan_.picture_invocations(), layout::kLinearGroup, frames_push(frames));
  commands.barrier();
  commands.mark("frames");
}

void ReplayPipeline::record_read_back(Commands& commands, const ReplayGroup& group, uint32_t frames) const {
  if (group.device_pictures.size() == 0) return;
  commands.copy(group.device_pictures, 0, group.pictures, 0, frames * plan_.picture_bytes());
  commands.mark("copy");
}

void ReplayPipeline::record_group(Commands& commands, const ReplayGroup& group, uint32_t events,
                                  uint32_t chunks, uint32_t frames) const {
  record_upload(commands, group, events, chunks);
  record_clear(commands, frames);
  if (events > 0) {
    record_count(commands, group, chunks);
    record_scan(commands, group, chunks);
    record_rank(commands, group, chunks);
    record_carry(commands, group, chunks);
    record_change(commands, group, chunks);
  }
  record_frames(commands, group, frames);
  record_read_back(commands, group, frames);
}

}  // namespace scarf
