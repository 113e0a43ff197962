#include "pipelines/replay/plan.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/streams.h"

namespace scarf {
namespace {

vulkan::Limits limits_of(uint32_t subgroup_size, uint32_t loop_trips, bool cpu) {
  vulkan::Limits limits;
  limits.storage_range = 128u << 20;
  limits.workgroups = 65'535;
  limits.subgroup_size = subgroup_size;
  limits.loop_trips = loop_trips;
  limits.cpu = cpu;
  return limits;
}

const vulkan::Limits kSmallDevice = limits_of(8, 60'000, true);

// Chunks must cover the group in order, none across a frame, none longer or more of them than planned.
void expect_cut(const ReplayPlan& plan, uint32_t events, const std::vector<uint32_t>& frames) {
  const auto chunks = cut_group(plan, events, frames);
  ASSERT_LE(chunks.size(), size_t{plan.max_chunks} + 1);
  ASSERT_EQ(chunks.front().begin, 0u);
  ASSERT_EQ(chunks.back().begin, events);
  for (size_t c = 0; c + 1 < chunks.size(); ++c) {
    const uint32_t begin = chunks[c].begin;
    const uint32_t end = chunks[c + 1].begin;
    ASSERT_LT(begin, end);
    ASSERT_LE(end - begin, plan.max_chunk_events);
    const uint32_t interval = chunks[c].interval;
    ASSERT_LE(interval, frames.size());
    ASSERT_TRUE(interval == 0 || frames[interval - 1] <= begin);
    ASSERT_TRUE(interval == frames.size() || end <= frames[interval]);
  }
}

TEST(ReplayPlan, StaysWithinTheLoopBudgetAndTheBuffersForEveryGeometryAndGroup) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Geometry g = test::random_geometry({64 + trial, 48 + trial}, random);
    if (trial % 3 == 0) {
      // As many patches per event as is legal.
      g.x = {g.x.size, 1, 0, g.x.size, 63, 64};
      g.y = {g.y.size, 1, 0, g.y.size, 63, 64};
    }
    if (trial % 5 == 0) g.capacity = kMaxCapacity;
    for (uint32_t subgroup : {1u, 4u, 8u, 32u, 128u}) {
      ReplayOptions options;
      options.group_frames = trial % 2 == 0 ? 0 : static_cast<uint32_t>(trial);
      options.group_events = trial % 4 == 0 ? 0 : static_cast<uint32_t>(100 * trial);
      options.chunk_events = trial % 7 == 0 ? 0 : static_cast<uint32_t>(trial);
      const auto pixels = trial % 2 == 0 ? ReplayPixels::u8 : ReplayPixels::f32;
      const vulkan::Limits limits = limits_of(subgroup, 60'000, true);
      const auto made = make_replay_plan(g, pixels, limits, options);
      ASSERT_TRUE(made) << made.error().message;
      const ReplayPlan& plan = *made;
      EXPECT_EQ(plan.workgroup_size(), subgroup);
      EXPECT_LE(plan.table_bytes(), limits.storage_range);
      EXPECT_LE(plan.changes_bytes(), limits.storage_range);
      EXPECT_LE(plan.pictures_bytes(), limits.storage_range);
      EXPECT_GE(uint64_t{plan.change_words()} * 32, uint64_t{plan.pixels} * plan.count_bits);
      EXPECT_LT(plan.capacity, 1u << plan.count_bits);
      EXPECT_GE(plan.group_frames, 1u);
      EXPECT_GE(plan.group_events, 1u);
      // The loops of rank; of scan; of frames; of count and change, with a search each.
      const uint64_t blocks = (plan.max_chunk_events + plan.team_lanes() - 1) / plan.team_lanes();
      EXPECT_LE(blocks * rank_trips(plan) + 1, limits.loop_trips);
      EXPECT_LE(plan.max_chunks + 1, limits.loop_trips);
      EXPECT_LE(plan.group_frames + 1, limits.loop_trips);
      EXPECT_LE((plan.max_chunk_events / layout::kLinearGroup + 1) * 20, limits.loop_trips);
      EXPECT_LE(plan.max_chunks, 1u << 16);

      const uint32_t most = plan.group_events;
      const uint32_t frames = plan.group_frames;
      ASSERT_NO_FATAL_FAILURE(expect_cut(plan, most, {}));
      ASSERT_NO_FATAL_FAILURE(expect_cut(plan, 0, {}));
      ASSERT_NO_FATAL_FAILURE(expect_cut(plan, 0, std::vector<uint32_t>(frames, 0)));
      ASSERT_NO_FATAL_FAILURE(expect_cut(plan, most, std::vector<uint32_t>(frames, most)));
      std::vector<uint32_t> anywhere(frames);
      for (uint32_t& f : anywhere) f = static_cast<uint32_t>(random()) % (most + 1);
      std::sort(anywhere.begin(), anywhere.end());
      ASSERT_NO_FATAL_FAILURE(expect_cut(plan, most, anywhere));
    }
  }
}

TEST(ReplayPlan, CutsAtFramesAndLongIntervals) {
  const Geometry g = *make_geometry(Preset::paper, {240, 180});
  const ReplayPlan plan = *make_replay_plan(g, ReplayPixels::u8, kSmallDevice, {.chunk_events = 10});
  const std::vector<uint32_t> frames = {0, 0, 7, 7, 30};
  const auto same = [](const layout::ReplayChunk& a, const layout::ReplayChunk& b) {
    return a.begin == b.begin && a.interval == b.interval;
  };
  // 32 events in at least 16 chunks: runs of 2.
  const std::vector<layout::ReplayChunk> expected = {{0, 2},  {2, 2},  {4, 2},  {6, 2},  {7, 4},  {9, 4},
                                                     {11, 4}, {13, 4}, {15, 4}, {17, 4}, {19, 4}, {21, 4},
                                                     {23, 4}, {25, 4}, {27, 4}, {29, 4}, {30, 5}, {32, 5}};
  const auto chunks = cut_group(plan, 32, frames);
  EXPECT_TRUE(std::equal(chunks.begin(), chunks.end(), expected.begin(), expected.end(), same));
}

TEST(ReplayPlan, ChoosesGroupsThatFitPicturesIntoTheirBudget) {
  const auto plan_on = [](SensorSize sensor, ReplayPixels pixels) {
    return *make_replay_plan(*make_geometry(Preset::paper, sensor), pixels, kSmallDevice, {});
  };
  const ReplayPlan large = plan_on({1280, 720}, ReplayPixels::u8);
  EXPECT_EQ(large.group_frames, 36u);  // 32 MiB / 921,600
  EXPECT_EQ(large.group_events, 1u << 20);
  EXPECT_EQ(large.count_bits, 8u);  // 233 slots
  EXPECT_EQ(large.team_x * large.team_y, 8u);
  EXPECT_EQ(plan_on({1280, 720}, ReplayPixels::counts).group_frames, 9u);
  EXPECT_EQ(plan_on({240, 180}, ReplayPixels::u8).group_frames, 776u);
}

TEST(ReplayPlan, RefusesByName) {
  const auto message = [](const Geometry& g, const vulkan::Limits& limits, const ReplayOptions& options) {
    const auto plan = make_replay_plan(g, ReplayPixels::u8, limits, options);
    return plan ? std::string() : plan.error().message;
  };
  const Geometry g = *make_geometry(Preset::paper, {240, 180});
  EXPECT_EQ(message(g, kSmallDevice, {.group_frames = 5000}), "group_frames is 5000, legal is 0 to 4096");
  EXPECT_EQ(message(g, kSmallDevice, {.group_events = 1u << 25}),
            "group_events is 33554432, legal is 0 to 16777216");
  EXPECT_EQ(message(g, kSmallDevice, {.chunk_events = 40'000}), "chunk_events is 40000, legal is 0 to 32768");
  // 441 slots: 16 bits per pixel, for a frame and for what comes after it.
  const Geometry huge = *make_geometry(Preset::light, {16'384, 16'384}, {.cell = 21});
  EXPECT_EQ(
      message(huge, kSmallDevice, {}),
      "a picture of a replay needs 1073741824 bytes, but a buffer of this device holds at most 134217728; "
      "use a smaller sensor or larger cells, or another device");
  vulkan::Limits tiny = kSmallDevice;
  tiny.storage_range = 4000;
  EXPECT_EQ(message(g, tiny, {}),
            "the table of a replay needs 8768 bytes, but a buffer of this device holds at most 4000; use a "
            "smaller sensor or larger cells, or another device");
  const Geometry fine = *checked_geometry({{3000, 1, 0, 3000, 0, 0}, {3000, 1, 0, 3000, 0, 0}, 5});
  EXPECT_NE(message(fine, kSmallDevice, {}).find("9000000 patches"), std::string::npos);
}

}  // namespace
}  // namespace scarf
