// Each shader stage of the replay against its CPU twin, on the buffers between the stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "cpu_ref/stages/replay/replay.h"
#include "pipelines/replay/pipeline.h"
#include "pipelines/scarf/plan.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;

class ReplayStages : public test::DeviceTest {
 protected:
  void use(const Geometry& geometry, ReplayPixels pixels, const ReplayOptions& options) {
    geometry_ = geometry;
    pixels_ = pixels;
    vulkan::Device& device = context_->vulkan();
    plan_ = test::value_of(make_replay_plan(geometry, pixels, device.limits(), options));
    levels_ = *make_levels(0.3, geometry.capacity);
    pipeline_ = test::value_of(ReplayPipeline::create(device, geometry, pixels, levels_, plan_));
    group_ = test::value_of(pipeline_->make_group());
    commands_ = test::value_of(Commands::create(device, device.compute()));
    run([&] { pipeline_->record_reset(commands_); });
    ranges_ = patch_ranges(geometry);
    heads_.assign(2 * size_t{plan_.patches}, 0);
    kept_.assign(size_t{plan_.patches} * plan_.kept_words(), 0);
    slots_.assign(size_t{plan_.patches} * plan_.capacity, 0);
    counts_.assign(plan_.change_words(), 0);
  }

  template <class Record>
  void run(Record record) {
    ASSERT_TRUE(commands_.begin());
    record();
    ASSERT_TRUE(commands_.submit());
    ASSERT_TRUE(commands_.wait());
  }

  template <class T = uint32_t>
  std::vector<T> read(const Buffer& buffer, size_t count) {
    const auto host =
        Buffer::create(context_->vulkan(), "test", count * sizeof(T), vulkan::MemoryUse::readback);
    EXPECT_TRUE(host);
    run([&] { commands_.copy(buffer, 0, *host, 0, count * sizeof(T)); });
    const T* words = host->mapped_as<T>();
    return {words, words + count};
  }

  // The words of patches, without those that lanes waste.
  std::vector<uint32_t> table_of(std::vector<uint32_t> words) const {
    for (size_t i = 0; i < words.size(); ++i) {
      if (i % plan_.stride() >= plan_.patches) words[i] = 0;
    }
    return words;
  }

  // Of the kept slots only: the others hold anything.
  std::vector<uint32_t> kept_pixels(std::vector<uint32_t> pixels) const {
    for (size_t i = 0; i < pixels.size(); ++i) {
      const size_t patch = i / plan_.capacity;
      const size_t slot = i % plan_.capacity;
      if ((kept_[patch * plan_.kept_words() + slot / 32] >> slot % 32 & 1) == 0) pixels[i] = 0;
    }
    return pixels;
  }

  void compare_group(std::vector<uint32_t> events, const std::vector<uint32_t>& frames) {
    const auto chunks = cut_group(plan_, static_cast<uint32_t>(events.size()), frames);
    std::copy(events.begin(), events.end(), group_->events.mapped_as<uint32_t>());
    std::copy(chunks.begin(), chunks.end(), group_->chunks.mapped_as<layout::ReplayChunk>());
    const auto count = static_cast<uint32_t>(chunks.size() - 1);
    const auto frame_count = static_cast<uint32_t>(frames.size());
    const stages::ReplayEvents group = {events, chunks};
    const layout::ReplayPush push = pipeline_->push(count);
    run([&] { pipeline_->record_upload(commands_, *group_, static_cast<uint32_t>(events.size()), count); });

    std::vector<uint32_t> table(size_t{count} * plan_.stride());
    stages::replay_count(group, ranges_, table, push);
    run([&] { pipeline_->record_count(commands_, *group_, count); });
    ASSERT_EQ(table_of(read(pipeline_->table(), table.size())), table) << "count";

    stages::replay_scan(table, heads_, push);
    run([&] { pipeline_->record_scan(commands_, *group_, count); });
    ASSERT_EQ(table_of(read(pipeline_->table(), table.size())), table) << "scan";
    ASSERT_EQ(read(pipeline_->heads(), heads_.size()), heads_) << "scan";

    std::vector<uint32_t> ranks(events.size(), layout::kReplayNone);
    stages::replay_rank(group, ranges_, table, ranks, push);
    run([&] { pipeline_->record_rank(commands_, *group_, count); });
    ASSERT_EQ(table_of(read(pipeline_->table(), table.size())), table) << "rank";
    const auto device_ranks = read(pipeline_->ranks(), ranks.size());
    for (size_t e = 0; e < ranks.size(); ++e) {
      if (ranks[e] == layout::kReplayNone) continue;  // in no cell
      ASSERT_EQ(device_ranks[e], ranks[e]) << "rank of event " << e;
    }

    std::vector<uint32_t> changes((frames.size() + 1) * plan_.change_words());
    const stages::ReplayState state = {table, heads_, changes, kept_, slots_};
    run([&] { pipeline_->record_clear(commands_, frame_count); });
    stages::replay_carry(group, state, push);
    run([&] { pipeline_->record_carry(commands_, *group_, count); });
    ASSERT_EQ(read(pipeline_->changes(), changes.size()), changes) << "carry";
    ASSERT_EQ(read(pipeline_->kept(), kept_.size()), kept_) << "carry";

    stages::replay_change(group, ranks, state, push);
    run([&] { pipeline_->record_change(commands_, *group_, count); });
    ASSERT_EQ(read(pipeline_->changes(), changes.size()), changes) << "change";
    ASSERT_EQ(read(pipeline_->kept(), kept_.size()), kept_) << "change";
    ASSERT_EQ(kept_pixels(read(pipeline_->pixels(), slots_.size())), kept_pixels(slots_)) << "change";

    run([&] {
      pipeline_->record_frames(commands_, *group_, frame_count);
      commands_.barrier();
      pipeline_->record_read_back(commands_, *group_, frame_count);
    });
    std::vector<int32_t> identity(plan_.capacity + 1);
    std::iota(identity.begin(), identity.end(), 0);
    if (pixels_ == ReplayPixels::u8) compare_frames<uint8_t>(changes, levels_.u8, frame_count);
    if (pixels_ == ReplayPixels::f32) compare_frames<float>(changes, levels_.f32, frame_count);
    if (pixels_ == ReplayPixels::counts) compare_frames<int32_t>(changes, identity, frame_count);
    ASSERT_EQ(read(pipeline_->counts(), counts_.size()), counts_) << "frames";
  }

  template <class Level>
  void compare_frames(const std::vector<uint32_t>& changes, const std::vector<Level>& levels,
                      uint32_t frames) {
    std::vector<Level> pictures(frames * plan_.picture_bytes() / sizeof(Level));
    stages::replay_frames<Level>(changes, counts_, levels, pictures, plan_.count_bits,
                                 pipeline_->frames_push(frames));
    const Level* found = group_->pictures.mapped_as<Level>();
    ASSERT_EQ(std::vector<Level>(found, found + pictures.size()), pictures) << "frames";
  }

  Geometry geometry_;
  ReplayPixels pixels_ = ReplayPixels::u8;
  ReplayPlan plan_;
  Levels levels_;
  std::unique_ptr<ReplayPipeline> pipeline_;
  std::unique_ptr<ReplayGroup> group_;
  Commands commands_;
  std::vector<uint32_t> ranges_, heads_, kept_, slots_, counts_;
};

TEST_F(ReplayStages, EqualTheirTwins) {
  std::mt19937 random(22);
  constexpr ReplayPixels kKinds[] = {ReplayPixels::u8, ReplayPixels::f32, ReplayPixels::counts};
  for (int trial = 0; trial < 18; ++trial) {
    const SensorSize sensor = {40 + 3 * trial, 70 - 2 * trial};
    const Geometry geometry = trial < 2 ? *make_geometry(trial == 0 ? Preset::paper : Preset::light, sensor)
                                        : test::random_geometry(sensor, random);
    SCOPED_TRACE(to_string(geometry));
    ReplayOptions options;
    options.chunk_events = trial % 2 == 0 ? 0 : 100;
    ASSERT_NO_FATAL_FAILURE(use(geometry, kKinds[trial % 3], options));
    for (uint32_t number = 0; number < 3; ++number) {
      std::vector<uint32_t> events;
      for (const Event& e : test::make_stream(test::kSpreads[trial % std::size(test::kSpreads)], sensor,
                                              1 + 900 * number, random())) {
        if (sensor.contains(e)) events.push_back(e.x | uint32_t{e.y} << 16);
      }
      std::vector<uint32_t> frames(number * 5);
      for (uint32_t& f : frames) f = static_cast<uint32_t>(random() % (events.size() + 1));
      std::sort(frames.begin(), frames.end());
      if (events.empty()) continue;
      ASSERT_NO_FATAL_FAILURE(compare_group(events, frames));
    }
  }
}

}  // namespace
}  // namespace scarf
