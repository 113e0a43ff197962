// Times cannot be asserted, work can: bytes, atomics and invocations per event of each preset on a small
// fixed stream are those in work_per_event.txt. More of them is a regression, fewer an improvement; both are
// to be seen in the change.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "bench/stage_work.h"
#include "core/text.h"
#include "scarf/core/image.h"
#include "tests/tools/event_fixtures.h"

namespace scarf::bench {
namespace {

constexpr SensorSize kSensor{240, 180};
constexpr uint32_t kEvents = 20'000;

vulkan::Limits limits_of(bool cpu) {
  vulkan::Limits limits;
  limits.storage_range = 128u << 20;
  limits.workgroups = 65'535;
  limits.subgroup_size = cpu ? 8 : 32;
  limits.loop_trips = cpu ? 60'000 : UINT32_MAX;
  limits.cpu = cpu;
  limits.lanes_in_step = cpu;
  limits.cores = cpu ? 2 : 1;
  return limits;
}

// A line per stage of a submission of all events and an 8-bit image, on a device like llvmpipe and on a GPU.
std::string work_of(Preset preset) {
  const Geometry geometry = *make_geometry(preset, kSensor);
  const auto events = tools::random_events(kEvents, kSensor);
  const Hits hits = count_hits(geometry, events);
  std::ostringstream lines;
  lines << std::fixed << std::setprecision(4);
  for (const bool cpu : {true, false}) {
    const auto levels = make_levels(kDefaultAccumulation, geometry.capacity);
    const Plan plan = *make_plan(geometry, levels->u8, limits_of(cpu), {});
    const std::string name = text(preset_name(preset), cpu ? " cpu " : " gpu ");
    const bool appended = plan.appended(kEvents);
    const Chunking chunking = plan.cut(kEvents);
    const uint64_t lanes =
        appended ? plan.append.invocations() : plan.teams(chunking.chunks, plan.stripes) * plan.team_lanes();
    lines << name << (appended ? "append" : "place") << " invocations "
          << static_cast<double>(lanes) / kEvents << "\n";
    auto work = push_work(plan, hits);
    const auto image = image_work(geometry, plan, hits);
    work.insert(work.end(), image.begin(), image.end());
    for (const StageWork& stage : work) {
      lines << name << stage.stage << " bytes " << stage.bytes / kEvents << " atomics "
            << stage.atomics / kEvents << "\n";
    }
  }
  return lines.str();
}

TEST(WorkPerEvent, IsThatOfTheList) {
  std::string now = "# preset, device, stage, and what it has to do per event\n";
  for (const Preset preset :
       {Preset::paper, Preset::light, Preset::event_driven, Preset::event_driven_flex}) {
    now += work_of(preset);
  }
  if (std::getenv("SCARF_UPDATE_WORK") != nullptr) {
    std::ofstream file(SCARF_WORK_LIST, std::ios::binary);
    ASSERT_TRUE(file << now) << SCARF_WORK_LIST;
  }
  std::ifstream file(SCARF_WORK_LIST, std::ios::binary);
  std::ostringstream listed;
  listed << file.rdbuf();
  std::istringstream ours(now);
  std::istringstream theirs(listed.str());
  const std::string advice =
      "if this is meant: SCARF_UPDATE_WORK=1 build/bench_test --gtest_filter='WorkPerEvent.*', "
      "and commit tests/bench/work_per_event.txt with the reason";
  for (std::string our, their; std::getline(ours, our);) {
    std::getline(theirs, their);
    ASSERT_EQ(our, their) << advice;
  }
  EXPECT_EQ(now, listed.str()) << advice;
}

}  // namespace
}  // namespace scarf::bench
