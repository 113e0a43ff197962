// Dispatches of two dimensions have workgroups beyond those that were asked for: these store nothing.
#include <gtest/gtest.h>

#include <random>

#include "core/ceil_div.h"
#include "pipelines/scarf/plan.h"
#include "tests/support/context.h"
#include "tests/support/streams.h"
#include "vulkan/commands.h"

namespace scarf {
namespace {

using test::value_of;
using vulkan::WorkgroupGrid;

TEST(WorkgroupGrid, HoldsAllWorkgroupsAndLessThanAColumnMore) {
  for (const uint32_t most : {1u, 2u, 4u, 7u, 65'535u, UINT32_MAX}) {
    for (const uint64_t wanted :
         {1u, 2u, 3u, 4u, 5u, 63u, 65'534u, 65'535u, 65'536u, 131'070u, 131'071u, 1'000'003u}) {
      const WorkgroupGrid grid = vulkan::workgroup_grid(wanted, most);
      const uint64_t made = uint64_t{grid.columns} * grid.rows;
      EXPECT_LE(grid.columns, most);
      EXPECT_GE(made, wanted);
      EXPECT_LT(made - wanted, grid.rows) << wanted << " workgroups, " << most << " side by side";
    }
  }
}

// What runs of the place stage without being beyond all teams; see is_beyond_teams() in
// shaders/common/team.glsl.
uint64_t storing_invocations(const Plan& plan, const Chunking& chunking, uint32_t most_columns) {
  const uint64_t teams = plan.teams(chunking.chunks, chunking.stripes);
  const uint64_t wanted = ceil_div(teams * plan.team_lanes(), plan.workgroup_size());
  const WorkgroupGrid grid = vulkan::workgroup_grid(wanted, most_columns);
  uint64_t storing = 0;
  for (uint64_t workgroup = 0; workgroup < uint64_t{grid.columns} * grid.rows; ++workgroup) {
    if (workgroup * plan.teams_per_workgroup < teams) storing += plan.workgroup_size();
  }
  return storing;
}

TEST(Dispatch, NoInvocationStoresBeyondTheUnusedEntries) {
  const std::vector<uint8_t> levels = make_levels(0.3, 233)->u8;
  std::mt19937 random(30);
  uint64_t beyond_rounded_up = 0;  // of plans whose dispatch has workgroups beyond the last
  for (int trial = 0; trial < 60; ++trial) {
    const Geometry g =
        trial == 0 ? *make_geometry(Preset::paper, {40, 40}) : test::random_geometry({40, 40}, random);
    for (const uint32_t workgroups : {4u, 65'535u}) {
      vulkan::Limits limits;
      limits.storage_range = 128u << 20;
      limits.workgroups = workgroups;
      limits.subgroup_size = 4u << trial % 4;
      limits.loop_trips = 60'000;
      limits.cpu = trial % 2 == 0;
      limits.cores = limits.cpu ? 2 : 1;
      GpuOptions options;
      options.chunk_events = 1;
      options.bands = 5;
      options.placing = GpuOptions::Placing::chunked;
      const Plan plan = value_of(make_plan(g, levels, limits, options));
      for (const uint32_t events : {1u, 3u, 1'000u, plan.submission_events}) {
        const Chunking chunking = plan.cut(std::min(events, plan.submission_events));
        ASSERT_LE(storing_invocations(plan, chunking, workgroups), plan.most_invocations());
        const uint64_t wanted =
            ceil_div(plan.teams(chunking.chunks, chunking.stripes), plan.teams_per_workgroup);
        const WorkgroupGrid grid = vulkan::workgroup_grid(wanted, workgroups);
        beyond_rounded_up += uint64_t{grid.columns} * grid.rows - wanted;
      }
    }
  }
  EXPECT_GT(beyond_rounded_up, 0u) << "nothing was tested";
}

// On the device, with guard bytes behind every buffer, that shaders reach.
class FewWorkgroups : public test::DeviceTest {
 protected:
  void SetUp() override {
    test::Pose pose = test::pose_of_environment();
    pose.few_workgroups = true;
    open(test::checked_options(), pose);
  }
};

TEST_F(FewWorkgroups, NothingIsStoredTwiceOrBeyondTheEnd) {
  using Placing = GpuOptions::Placing;
  for (const SensorSize sensor : {SensorSize{40, 40}, SensorSize{97, 61}}) {
    for (const Preset preset : {Preset::paper, Preset::light}) {
      for (const Placing placing : {Placing::chunked, Placing::appended}) {
        for (const uint32_t bands : {1u, 5u}) {
          const Geometry geometry = *make_geometry(preset, sensor);
          GpuOptions options;
          options.chunk_events = 1;
          options.bands = bands;
          options.placing = placing;
          const auto device = device_scarf(geometry, options);
          const auto reference = reference_scarf(geometry);
          for (const size_t count : {1, 2, 3, 5, 77, 1001}) {
            const auto events = test::make_stream(test::Spread::uniform, sensor, count, count);
            ASSERT_TRUE(device->push(events));
            ASSERT_TRUE(reference->push(events));
            ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference)) << to_string(geometry);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace scarf
