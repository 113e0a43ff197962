// Every allocation of a replay is made to fail: the frames that come are the first ones of the whole, and
// what is missing is told.
#include "scarf/device/replay.h"

#include <gtest/gtest.h>

#include "tests/allocations/quiet_device.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::ours;

constexpr SensorSize kSensor = {40, 30};
const std::vector<Event> kEvents = test::make_stream(test::Spread::uniform, kSensor, 400, 1);
using Frames = std::vector<std::vector<uint8_t>>;

TEST(ReplayLack, OfEachAllocationIsToldAndStaysAnError) {
  const auto context = test::value_of(test::quiet_context());
  const auto geometry = test::value_of(make_geometry(Preset::paper, kSensor));
  Frames whole;
  test::fail_each_allocation(
      [&] {
        Frames frames;
        const TakeReplayFrame<uint8_t> take = [&](const ReplayFrame<uint8_t>& frame) -> Result<void> {
          const test::FailingNew::Pause pause;
          frames.emplace_back(frame.pixels.begin(), frame.pixels.end());
          return {};
        };
        const auto replay = ours([&] {
          return make_gpu_replay<uint8_t>(context, geometry, take, kDefaultAccumulation, {.group_frames = 1});
        });
        if (!replay) return test::expect_lack(replay.error());
        bool failed = false;
        const auto note = [&](const auto& result) {
          if (!result) test::expect_lack(result.error());
          EXPECT_FALSE(result && failed) << "a replay went on after a failure";
          failed = failed || !result;
        };
        for (size_t i = 0; i < kEvents.size(); i += 100) {
          note(ours([&] { return (*replay)->push(std::span(kEvents).subspan(i, 100)); }));
          note(ours([&] { return (*replay)->frame(); }));
        }
        note(ours([&] { return (*replay)->finish(); }));
        if (whole.empty()) whole = frames;
        ASSERT_LE(frames.size(), whole.size());
        EXPECT_TRUE(std::equal(frames.begin(), frames.end(), whole.begin()));
        EXPECT_TRUE(failed || frames.size() == whole.size());
        EXPECT_EQ((*replay)->finish().ok(), !failed);
      },
      80);
  EXPECT_EQ(whole.size(), 4u);
}

// Other exceptions than lack of memory are not scarf's: they come out, and end the replay.
TEST(ReplayLack, WhatTheTakerThrowsComesOutAndEndsTheReplay) {
  const auto context = test::value_of(test::quiet_context());
  const auto geometry = test::value_of(make_geometry(Preset::paper, kSensor));
  const TakeReplayFrame<uint8_t> take = [](const ReplayFrame<uint8_t>&) -> Result<void> {
    throw std::runtime_error("a frame too many");
  };
  const auto replay = test::value_of(make_gpu_replay<uint8_t>(context, geometry, take));
  ASSERT_TRUE(replay->push(kEvents) && replay->frame());
  EXPECT_THROW((void)replay->finish(), std::runtime_error);
  const auto after = replay->finish();
  ASSERT_FALSE(after);
  EXPECT_EQ(after.error().code, ErrorCode::illegal_parameter);
}

}  // namespace
}  // namespace scarf
