// Work of stages by hand, on a grid of 2x2 patches.
#include "bench/stage_work.h"

#include <gmock/gmock.h>

#include "bench/stages.h"
#include "scarf/core/image.h"
#include "scarf/device/stream.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/tools/event_fixtures.h"

namespace scarf::bench {
namespace {

// Cells of 4 pixels, fields of 6: a pixel of the two middle rows or columns lies in two patches per axis.
constexpr GridAxis kAxis = {.size = 8, .cell = 4, .origin = 0, .grid = 2, .margin_lo = 1, .margin_hi = 1};
constexpr Geometry kGeometry = {.x = kAxis, .y = kAxis, .capacity = 3};

Plan plan_of(bool paints) {
  Plan plan;
  plan.patches = 4;
  plan.capacity = 3;
  plan.most_columns = plan.most_rows = 2;
  plan.max_chunk_events = 10;
  plan.max_chunks = 5;
  plan.target_chunks = 2;
  plan.class_columns = plan.class_rows = 4;  // no patch, the left one, both, the right one
  plan.paints = paints;
  plan.position_groups = 1;
  return plan;
}

double bytes_of(const std::vector<StageWork>& all, std::string_view stage) {
  for (const StageWork& work : all) {
    if (work.stage == stage) return work.bytes;
  }
  return -1;
}

TEST(CountHits, TellsStoredOnesFromOverwrittenOnes) {
  // Five events in the corner of patch 0, one in the middle of all four, one outside the sensor.
  std::vector<Event> events(5, Event{0, 0, 0, 1});
  events.push_back({1, 4, 3, 0});
  events.push_back({2, 8, 0, 0});
  const Hits hits = count_hits(kGeometry, events);
  EXPECT_EQ(hits.events, 7u);
  EXPECT_EQ(hits.hits, 9u);
  EXPECT_EQ(hits.stored, 6u) << "three of patch 0, one of each other";
  EXPECT_EQ(hits.patches, 4u);
}

TEST(StageWork, OfAPushThatIsPruned) {
  const Hits hits = {.events = 20, .hits = 30, .stored = 9, .patches = 3};
  const auto all = push_work(plan_of(/*paints=*/true), hits);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(bytes_of(all, "clear"), 2 * 16 * 4) << "2 chunks of 16 classes";
  EXPECT_EQ(bytes_of(all, "count"), 20 * 16 + 20 * 8);
  EXPECT_EQ(bytes_of(all, "sum"), 2 * (2 * 16 * 8));
  EXPECT_EQ(bytes_of(all, "scan"), 2 * 16 * 4 + 3 * (2 * 4 * 4) + 4 * 12 * 2 + 3 * 4);
  EXPECT_EQ(bytes_of(all, "prune"), 2 * 4 * 4 + 2 * 4 * 4);
  EXPECT_EQ(bytes_of(all, "place"), 20 * 16 + 8 * 4 + 8 * 8 + 9 * 9) << "fewer entries than events and hits";
  for (const StageWork& work : all) EXPECT_EQ(work.atomics, work.stage == "count" ? 20 : 0) << work.stage;
}

TEST(StageWork, OfAPushThatIsNotPruned) {
  const Hits hits = {.events = 2, .hits = 3, .stored = 3, .patches = 2};
  const auto all = push_work(plan_of(/*paints=*/false), hits);
  EXPECT_EQ(all.size(), 5u);
  EXPECT_EQ(bytes_of(all, "count"), 2 * 16 + 2 * 8);
  EXPECT_EQ(bytes_of(all, "place"), 2 * 16 + 3 * 8 + 3 * 8);
}

TEST(StageWork, EachBandReadsTheEventsAgain) {
  const Hits hits = {.events = 20, .hits = 30, .stored = 9, .patches = 3};
  Plan plan = plan_of(/*paints=*/true);
  plan.bands = 2;
  EXPECT_EQ(bytes_of(push_work(plan, hits), "place"), 2 * (20 * 16 + 8 * 4) + 8 * 8 + 9 * 9);
}

TEST(StageWork, OfAPushThatIsAppended) {
  const Hits hits = {.events = 20, .hits = 30, .stored = 9, .patches = 3};
  Plan plan = plan_of(/*paints=*/true);
  plan.always_appends = true;
  plan.append.parts_shift = 1;
  plan.append.bands = 3;
  const auto all = push_work(plan, hits);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(bytes_of(all, "append"), 6 * 20 * 16 + 3 * 8 + 30 * 9)
      << "2 parts of 3 bands; nothing is left out";
}

TEST(StageWork, OfImages) {
  const Hits hits = {.events = 20, .hits = 30, .stored = 9, .patches = 3};
  const auto painted = image_work(kGeometry, plan_of(/*paints=*/true), hits);
  ASSERT_EQ(painted.size(), 2u);
  EXPECT_EQ(bytes_of(painted, "paint"), 2 * 4 * 4 + 3 * (4 + 16 + 16));
  EXPECT_EQ(bytes_of(painted, "copy"), 2 * 64);
  const auto rendered = image_work(kGeometry, plan_of(/*paints=*/false), hits);
  ASSERT_EQ(rendered.size(), 3u);
  EXPECT_EQ(bytes_of(rendered, "render"), 64 * 4 + 12 * 8 + 4 * 12 + 12 * 8) << "12 slots, 64 pixels";
  EXPECT_EQ(bytes_of(rendered, "tone"), 64 * 4 + 64);
}

using StagesOnDevice = test::DeviceTest;

TEST_F(StagesOnDevice, EveryStageHasTimeAndWork) {
  const Geometry geometry = test::value_of(make_geometry(Preset::light, {64, 48}));
  const auto scarf = test::value_of(make_gpu_scarf(context_, geometry));
  const auto levels = test::value_of(make_levels(kDefaultAccumulation, geometry.capacity));
  const Plan plan = test::value_of(make_plan(geometry, levels.u8, context_->vulkan().limits(), {}));
  const auto events = tools::random_events(150'000, geometry.sensor());
  const auto figures = test::value_of(measure_stages(*scarf, plan, events));
  if (scarf->stage_times().empty()) GTEST_SKIP() << "no timestamps";
  std::vector<std::string> stages;
  for (const StageFigure& figure : figures) {
    if (figure.stage == "upload" || figure.stage == "unpack") continue;
    stages.push_back(figure.stage);
    EXPECT_GT(figure.bytes_per_event.value_or(0), 0) << figure.stage;
    EXPECT_EQ(figure.atomics_per_event, figure.stage == "count" ? 1 : 0) << figure.stage;
  }
  EXPECT_THAT(stages, testing::IsSupersetOf({"clear", "count", "sum", "scan", "place", "copy"}));
}

}  // namespace
}  // namespace scarf::bench
