#include "pipelines/scarf/plan.h"

#include <gtest/gtest.h>

#include <random>

#include "core/ceil_div.h"
#include "scarf/core/image.h"
#include "shaders/common/layout.h"
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
  limits.lanes_in_step = cpu;
  limits.cores = cpu ? 2 : 1;
  return limits;
}

const std::vector<uint8_t> kLevels = make_levels(0.3, 233)->u8;

// The largest number of trips that one invocation of the place stage takes, the entry of its loop
// included.
uint64_t walk_trips(const Plan& plan, const Chunking& chunking) {
  const uint64_t blocks = (chunking.chunk_events + plan.team_lanes() - 1) / plan.team_lanes();
  return blocks * trips_per_block(plan) + 1;
}

TEST(Plan, StaysWithinTheLoopBudgetForEveryGeometryAndBatch) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    Geometry g = test::random_geometry({64 + trial, 48 + trial}, random);
    if (trial % 3 == 0) {
      // As many patches per event as is legal.
      g.x = {g.x.size, 1, 0, g.x.size, 63, 64};
      g.y = {g.y.size, 1, 0, g.y.size, 63, 64};
    }
    for (uint32_t subgroup : {1u, 4u, 8u, 16u, 32u, 64u, 128u}) {
      for (uint32_t chunk_events : {0u, 1u, 500u, 32'768u}) {
        const vulkan::Limits limits = limits_of(subgroup, 60'000, true);
        GpuOptions options;
        options.chunk_events = chunk_events;
        const auto plan = make_plan(g, kLevels, limits, options);
        ASSERT_TRUE(plan) << plan.error().message;
        EXPECT_EQ(plan->workgroup_size(), subgroup);
        EXPECT_LE(plan->team_lanes(), 32u);
        EXPECT_LE(plan->table_words() * 4, limits.storage_range);
        EXPECT_LE(uint64_t{plan->class_words()} * plan->max_chunks * 4, limits.storage_range);
        EXPECT_LE(2 * (uint64_t{plan->max_chunks} + 1), limits.loop_trips);
        for (uint32_t events : {1u, plan->max_chunk_events, plan->max_chunk_events + 1,
                                plan->submission_events - 1, plan->submission_events}) {
          if (events == 0 || events > plan->submission_events) continue;
          const Chunking chunking = plan->cut(events);
          ASSERT_LE(walk_trips(*plan, chunking), limits.loop_trips);
          ASSERT_LE(chunking.chunk_events, layout::kMaxChunkEvents);
          ASSERT_LE(chunking.chunks, plan->max_chunks);
          ASSERT_GE(uint64_t{chunking.chunk_events} * chunking.chunks, events);
          ASSERT_LT(uint64_t{chunking.chunk_events} * (chunking.chunks - 1), events);
        }
      }
    }
  }
}

TEST(Plan, AppendsWithinTheLoopBudget) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const Geometry g = test::random_geometry({64 + trial, 48 + trial}, random);
    for (uint32_t subgroup : {1u, 4u, 8u, 32u, 64u}) {
      vulkan::Limits limits = limits_of(subgroup, 60'000, trial % 2 == 0);
      limits.cores = 1 + trial % 9;
      const AppendPlan a = make_plan(g, kLevels, limits, {})->append;
      EXPECT_EQ(a.lanes, subgroup);
      EXPECT_LE(a.team_x * a.team_y * a.teams, subgroup);
      EXPECT_LE(a.teams, static_cast<uint32_t>(g.capacity)) << "slots of one step must differ";
      EXPECT_LE(a.parts(), limits.cores);
      EXPECT_GE(uint64_t{a.bands} * a.band_rows * a.parts(), static_cast<uint64_t>(g.y.grid));
      const uint64_t blocks = ceil_div(a.dispatch_events, std::min(subgroup, 32u));
      EXPECT_GT(blocks, 0u);
      EXPECT_LE(blocks * trips_per_block(a) + 1, limits.loop_trips);
      EXPECT_LE(a.dispatch_events, kMostAppendEvents);
    }
  }
}

TEST(Plan, AppendsOnFewCoresWhereLittleIsOverwritten) {
  const Geometry small = *make_geometry(Preset::paper, {240, 180});
  vulkan::Limits cpu = limits_of(8, 60'000, true);
  const auto appended = [&](const vulkan::Limits& limits, uint32_t events, const GpuOptions& options = {}) {
    return make_plan(small, kLevels, limits, options)->appended(events);
  };
  EXPECT_TRUE(appended(cpu, 10'000));
  EXPECT_FALSE(appended(cpu, 200'000)) << "pruned";
  EXPECT_FALSE(appended(cpu, 10'000, {.chunk_events = 100}));
  EXPECT_FALSE(appended(cpu, 10'000, {.placing = GpuOptions::Placing::chunked}));
  EXPECT_TRUE(appended(cpu, 200'000, {.placing = GpuOptions::Placing::appended}));
  cpu.cores = 16;
  EXPECT_FALSE(appended(cpu, 10'000)) << "parts for some of the cores only";
  EXPECT_FALSE(appended(limits_of(32, UINT32_MAX, false), 10'000));
}

TEST(Plan, EveryPatchOfAnEventHasOneLane) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const Geometry g = test::random_geometry({100, 60}, random);
    for (uint32_t subgroup : {4u, 8u, 32u}) {
      const Plan plan = *make_plan(g, kLevels, limits_of(subgroup, UINT32_MAX, false), {});
      for (int32_t x = 0; x < g.x.size; ++x) {
        const PatchRange range = g.x.patches_holding(x);
        EXPECT_LE(range.last - range.first + 1, static_cast<int32_t>(plan.team_x * plan.lane_columns));
      }
      for (int32_t y = 0; y < g.y.size; ++y) {
        const PatchRange range = g.y.patches_holding(y);
        EXPECT_LE(range.last - range.first + 1, static_cast<int32_t>(plan.team_y * plan.lane_rows));
      }
    }
  }
}

TEST(Plan, PrunesWhereMostHitsAreOverwritten) {
  const vulkan::Limits limits = limits_of(8, 60'000, true);
  const Plan small = *make_plan(*make_geometry(Preset::paper, {240, 180}), kLevels, limits, {});
  EXPECT_TRUE(small.cut(100'000).prune);
  EXPECT_FALSE(small.cut(10'000).prune);
  const Plan large = *make_plan(*make_geometry(Preset::paper, {1280, 720}), kLevels, limits, {});
  EXPECT_FALSE(large.cut(100'000).prune);
}

TEST(Plan, PaintsSmallCellsOfFewLevels) {
  const vulkan::Limits limits = limits_of(8, 60'000, true);
  const Geometry small = *make_geometry(Preset::paper, {240, 180});
  EXPECT_TRUE(make_plan(small, kLevels, limits, {})->paints);
  EXPECT_FALSE(make_plan(small, make_levels(0.01, 233)->u8, limits, {})->paints);
  const Geometry large = *make_geometry(Preset::paper, {240, 180}, {.cell = 16, .ratio = 0.2, .alpha = 1});
  EXPECT_FALSE(make_plan(large, kLevels, limits, {})->paints);
  const Geometry deep = *make_geometry(Preset::paper, {240, 180}, {.alpha = 2.2});
  EXPECT_GT(deep.capacity, 255);
  EXPECT_FALSE(make_plan(deep, kLevels, limits, {})->paints);
}

TEST(Plan, FewerChunksWhereTheirCountsAreLarge) {
  const vulkan::Limits limits = limits_of(8, 60'000, true);
  const Plan small = *make_plan(*make_geometry(Preset::paper, {240, 180}), kLevels, limits, {});
  const Plan large = *make_plan(*make_geometry(Preset::paper, {1280, 720}), kLevels, limits, {});
  EXPECT_GT(small.target_chunks, large.target_chunks);
  EXPECT_EQ(large.target_chunks, 4u);
}

TEST(Plan, BandsCoverAllRowsAndAreManyOnlyWhereRingsAreMany) {
  const vulkan::Limits cpu = limits_of(8, 60'000, true);
  const Geometry small = *make_geometry(Preset::paper, {240, 180});
  const Geometry large = *make_geometry(Preset::paper, {1280, 720});
  EXPECT_EQ(make_plan(small, kLevels, cpu, {})->bands, 1u);
  EXPECT_EQ(make_plan(large, kLevels, cpu, {})->bands, 3u);
  EXPECT_EQ(make_plan(large, kLevels, limits_of(32, UINT32_MAX, false), {})->bands, 1u);
  EXPECT_EQ(make_plan(small, kLevels, cpu, {})->append.bands, 1u);
  EXPECT_EQ(make_plan(large, kLevels, cpu, {})->append.bands, 2u);
  const Geometry few_hits = *make_geometry(Preset::light, {1280, 720});
  EXPECT_EQ(make_plan(few_hits, kLevels, cpu, {})->append.bands, 1u);
  EXPECT_EQ(make_plan(few_hits, kLevels, cpu, {.bands = 5})->append.bands, 5u);
  for (const Geometry& g : {small, large}) {
    for (uint32_t bands = 1; bands <= 64; ++bands) {
      const Plan plan = *make_plan(g, kLevels, cpu, {.bands = bands});
      const auto rows = static_cast<uint32_t>(g.y.grid);
      EXPECT_LE(plan.bands, bands);
      EXPECT_GE(plan.bands * plan.band_rows, rows);
      EXPECT_LT((plan.bands - 1) * plan.band_rows, rows);
    }
  }
}

TEST(Plan, FewerChunksForSmallBatches) {
  const Geometry g = *make_geometry(Preset::paper, {240, 180});  // a team per subgroup
  const Plan cpu = *make_plan(g, kLevels, limits_of(8, 60'000, true), {});
  EXPECT_EQ(cpu.cut(10'000).chunks, 2u);  // one for each core
  EXPECT_EQ(cpu.cut(50'000).chunks, 50'000 / cpu.least_chunk_events / 2 * 2);
  EXPECT_EQ(cpu.cut(200'000).chunks, cpu.target_chunks);
  EXPECT_EQ(cpu.cut(1).chunks, 1u);
  // Small counts: short chunks.
  const Plan tiny =
      *make_plan(*make_geometry(Preset::paper, {32, 24}), kLevels, limits_of(8, 60'000, true), {});
  EXPECT_EQ(tiny.cut(10'000).chunks, tiny.target_chunks);
  const Plan gpu = *make_plan(g, kLevels, limits_of(32, UINT32_MAX, false), {});
  EXPECT_GE(gpu.cut(10'000).chunk_events, 64u);
  EXPECT_EQ(gpu.cut(2048 * 100).chunks, gpu.target_chunks);
  // Bands of few chunks occupy the cores, too.
  const Geometry wide = *make_geometry(Preset::light, {1280, 720});  // two teams per subgroup
  const Plan banded = *make_plan(wide, kLevels, limits_of(8, 60'000, true), {.bands = 4});
  EXPECT_EQ(banded.cut(4'000).chunks, 1u);
  EXPECT_EQ(banded.cut(4'000).stripes, 1u);
  EXPECT_EQ(banded.teams(1, 1), 4u);
  EXPECT_EQ(banded.cut(200'000).stripes, 2u);
  // Streams of small batches need little memory for chunks.
  GpuOptions small;
  small.submission_events = 10'000;
  const Plan few = *make_plan(g, kLevels, limits_of(32, UINT32_MAX, false), small);
  EXPECT_GE(few.max_chunks, few.cut(10'000).chunks);
  EXPECT_LT(few.max_chunks, gpu.max_chunks / 10);
  GpuOptions forced;
  forced.chunk_events = 7;
  EXPECT_EQ(make_plan(g, kLevels, limits_of(8, 60'000, true), forced)->cut(70).chunks, 10u);
}

TEST(Plan, RefusesOptionsOutOfRangeByName) {
  const Geometry g = *make_geometry(Preset::paper, {64, 48});
  const auto message = [&](GpuOptions options) {
    const auto plan = make_plan(g, kLevels, limits_of(8, 60'000, true), options);
    return plan ? std::string("accepted") : plan.error().message;
  };
  GpuOptions slots;
  slots.staging_slots = 0;
  EXPECT_EQ(message(slots), "staging_slots is 0, legal is 1 to 16");
  GpuOptions chunk;
  chunk.chunk_events = 32'769;
  EXPECT_EQ(message(chunk), "chunk_events is 32769, legal is 0 to 32768");
  GpuOptions bands;
  bands.bands = 65;
  EXPECT_EQ(message(bands), "bands is 65, legal is 0 to 64");
  GpuOptions submission;
  submission.submission_events = (1u << 24) + 1;
  EXPECT_EQ(message(submission), "submission_events is 16777217, legal is 0 to 16777216");
}

TEST(Plan, RefusesAGridBeyondTheDeviceByName) {
  const Geometry g = *checked_geometry({{16'384, 4, 0, 4096, 0, 0}, {16'384, 4, 0, 4096, 0, 0}, 1});
  const auto plan = make_plan(g, kLevels, limits_of(8, 60'000, true), {});
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::out_of_memory);
  EXPECT_NE(plan.error().message.find("16777216 patches"), std::string::npos);
}

TEST(PatchRanges, MarkPixelsThatNoFieldHolds) {
  // Two patches of 2 pixels at 4..7 on an axis of 10 pixels, fields one pixel wider.
  const Geometry g = *checked_geometry({{10, 2, 4, 2, 1, 1}, {1, 1, 0, 1, 0, 0}, 1});
  const std::vector<uint32_t> expected = {1, 1, 1, 0, 0, 1u << 16, 1u << 16, 1 | 1u << 16, 1 | 1u << 16,
                                          1, 1, 0, 1};
  EXPECT_EQ(patch_ranges(g), expected);
}

}  // namespace
}  // namespace scarf
