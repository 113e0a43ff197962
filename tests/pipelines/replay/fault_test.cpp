// Every Vulkan call is made to fail once while a recording is replayed.
#include <gtest/gtest.h>

#include "scarf/device/replay.h"
#include "tests/support/faults.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Faults;

const std::vector<Event> kEvents = test::make_stream(test::Spread::uniform, {40, 30}, 400, 1);

struct Outcome {
  std::optional<Error> error;  // the first one
  std::vector<std::vector<uint8_t>> frames;
};

Outcome use_everything(DeviceOptions::Upload upload) {
  Outcome outcome;
  const auto note = [&](const auto& result) {
    if (!result && !outcome.error) outcome.error = result.error();
    return result.ok();
  };
  const auto context = test::faulty_context(upload);
  if (!note(context)) return outcome;
  const TakeReplayFrame<uint8_t> take = [&](const ReplayFrame<uint8_t>& frame) -> Result<void> {
    outcome.frames.emplace_back(frame.pixels.begin(), frame.pixels.end());
    return {};
  };
  const auto replay = make_gpu_replay<uint8_t>(*context, *make_geometry(Preset::paper, {40, 30}), take,
                                               kDefaultAccumulation, {.group_frames = 1});
  if (note(replay)) {
    for (size_t i = 0; i < kEvents.size(); i += 100) {
      note((*replay)->push(std::span(kEvents).subspan(i, 100)));
      note((*replay)->frame());
    }
    note((*replay)->finish());
  }
  Faults::stop_device = nullptr;
  return outcome;
}

class ReplayFault : public testing::TestWithParam<std::pair<VkResult, DeviceOptions::Upload>> {
 protected:
  void TearDown() override { Faults::arm(0, VK_SUCCESS); }
};

TEST_P(ReplayFault, OfEachCallIsReportedAndLosesNothingSilently) {
  const auto [result, upload] = GetParam();
  Faults::arm(0, VK_SUCCESS);
  const Outcome whole = use_everything(upload);
  ASSERT_FALSE(whole.error) << whole.error->message;
  ASSERT_EQ(whole.frames.size(), 4u);
  const int calls = Faults::calls;
  ASSERT_GT(calls, 80);

  int unreported = 0;
  for (int n = 1; n <= calls; ++n) {
    SCOPED_TRACE(n);
    Faults::arm(n, result);
    const Outcome outcome = use_everything(upload);
    // What was handed out nevertheless is right, and the beginning of the whole.
    ASSERT_LE(outcome.frames.size(), whole.frames.size());
    for (size_t i = 0; i < outcome.frames.size(); ++i) ASSERT_EQ(outcome.frames[i], whole.frames[i]);
    if (!outcome.error) {
      ++unreported;
      ASSERT_EQ(outcome.frames.size(), whole.frames.size());
      continue;
    }
    EXPECT_EQ(outcome.error->code, test::reported_as(result)) << outcome.error->message;
  }
  // Only timestamps and the wait for idleness at the end may fail unnoticed.
  EXPECT_LE(unreported, calls / 10);
}

INSTANTIATE_TEST_SUITE_P(Results, ReplayFault,
                         testing::Values(std::pair(VK_ERROR_DEVICE_LOST, DeviceOptions::Upload::automatic),
                                         std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                                   DeviceOptions::Upload::staged)));

}  // namespace
}  // namespace scarf
