// Every Vulkan call is made to fail once: the error is the right one, nothing is lost silently, nothing
// crashes.
#include <gtest/gtest.h>

#include "scarf/reference/reference.h"
#include "tests/support/faults.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Faults;

const Geometry kGeometry = *make_geometry(Preset::paper, {40, 30});
const std::vector<Event> kEvents = test::make_stream(test::Spread::uniform, {40, 30}, 3000, 1);

struct Outcome {
  std::optional<Error> error;  // the first one
  std::optional<Snapshot> state;
  std::optional<Image<uint8_t>> image;
  std::optional<std::vector<Event>> events;
};

// Everything that a user does, up to the first failure; then the rest is tried all the same, and must not
// crash.
Outcome use_everything(DeviceOptions::Upload upload) {
  Outcome outcome;
  const auto note = [&](const auto& result) {
    if (!result && !outcome.error) outcome.error = result.error();
    return result.ok();
  };
  const auto context = test::faulty_context(upload);
  if (!note(context)) return outcome;
  GpuOptions gpu;
  gpu.submission_events = 1000;
  auto scarf = make_gpu_scarf(*context, kGeometry, kDefaultAccumulation, gpu);
  if (!note(scarf)) return outcome;
  note((*scarf)->push(kEvents));
  auto image = (*scarf)->u8_image().wait();
  note(image);
  auto events = (*scarf)->active_events().wait();
  note(events);
  auto state = (*scarf)->snapshot().wait();
  note(state);
  note((*scarf)->finish());
  Faults::stop_device = nullptr;
  if (image) outcome.image = *image;
  if (events) outcome.events = *events;
  if (state) outcome.state = *state;
  return outcome;
}

class Fault : public testing::TestWithParam<std::pair<VkResult, DeviceOptions::Upload>> {
 protected:
  void TearDown() override { Faults::arm(0, VK_SUCCESS); }
};

TEST_P(Fault, OfEachCallIsReportedAndLosesNothingSilently) {
  const auto [result, upload] = GetParam();
  Faults::arm(0, VK_SUCCESS);
  const Outcome whole = use_everything(upload);
  ASSERT_FALSE(whole.error) << whole.error->message;
  const int calls = Faults::calls;
  ASSERT_GT(calls, 80);

  auto reference = *make_reference_scarf(kGeometry);
  ASSERT_TRUE(reference->push(kEvents));
  const Snapshot expected = test::value_of(reference->snapshot());
  EXPECT_EQ(whole.state->slots, expected.slots);

  int unreported = 0;
  for (int n = 1; n <= calls; ++n) {
    SCOPED_TRACE(n);
    Faults::arm(n, result);
    const Outcome outcome = use_everything(upload);
    if (outcome.error) {
      EXPECT_EQ(outcome.error->code, test::reported_as(result)) << outcome.error->message;
      EXPECT_NE(outcome.error->message.find("vk"), std::string::npos) << outcome.error->message;
    } else {
      ++unreported;
    }
    // Whatever was handed out is whole.
    if (outcome.state) {
      EXPECT_EQ(outcome.state->totals, expected.totals);
      EXPECT_EQ(outcome.state->slots, expected.slots);
    }
    if (outcome.image) {
      EXPECT_EQ(*outcome.image, *whole.image);
    }
    if (outcome.events) {
      EXPECT_EQ(*outcome.events, *whole.events);
    }
  }
  // Only timestamps, a poll that is repeated, and the wait for idleness at the end may fail unnoticed.
  EXPECT_LE(unreported, calls / 10);
}

std::string fault_name(const testing::TestParamInfo<std::pair<VkResult, DeviceOptions::Upload>>& info) {
  const std::string upload =
      info.param.second == DeviceOptions::Upload::automatic ? "Direct" : "TransferQueue";
  switch (info.param.first) {
    case VK_ERROR_DEVICE_LOST:
      return "DeviceLost" + upload;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "OutOfDeviceMemory" + upload;
    default:
      return "OutOfHostMemory" + upload;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Results, Fault,
    testing::Values(std::pair(VK_ERROR_DEVICE_LOST, DeviceOptions::Upload::automatic),
                    std::pair(VK_ERROR_DEVICE_LOST, DeviceOptions::Upload::transfer_queue),
                    std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY, DeviceOptions::Upload::automatic),
                    std::pair(VK_ERROR_OUT_OF_HOST_MEMORY, DeviceOptions::Upload::transfer_queue)),
    fault_name);

// The heads of rings are full when the next submission begins with settling them. If that gets lost, it must
// not be taken for done.
TEST(SettlingFault, LeavesTheHeadsToTheNextSubmission) {
  constexpr size_t kMostLaps = 65'535;
  const Geometry one_slot = {{1, 1, 0, 1, 0, 0}, {1, 1, 0, 1, 0, 0}, 1};
  std::vector<Event> events(kMostLaps + 10);
  for (size_t i = 0; i < events.size(); ++i) events[i].t = static_cast<int64_t>(i);
  auto reference = *make_reference_scarf(one_slot);
  ASSERT_TRUE(reference->push(events));
  Faults::arm(0, VK_SUCCESS);
  const auto context = test::value_of(test::faulty_context(DeviceOptions::Upload::automatic));
  GpuOptions gpu;
  gpu.submission_events = 1 << 17;
  gpu.placing = GpuOptions::Placing::appended;
  bool failed = true;
  int n = 0;
  while (failed) {
    ++n;
    SCOPED_TRACE(n);
    Faults::arm(0, VK_SUCCESS);
    auto scarf = test::value_of(make_gpu_scarf(context, one_slot, kDefaultAccumulation, gpu));
    ASSERT_TRUE(scarf->push(std::span(events).first(kMostLaps)) && scarf->finish());
    ASSERT_TRUE(scarf->push(std::span(events).subspan(kMostLaps)));
    Faults::arm(n, VK_ERROR_OUT_OF_HOST_MEMORY);
    (void)scarf->flush();
    failed = Faults::calls >= n;
    Faults::arm(0, VK_SUCCESS);
    ASSERT_TRUE(scarf->flush());
    ASSERT_NO_FATAL_FAILURE(test::expect_same_state(*scarf, *reference));
  }
  EXPECT_GT(n, 4);  // the submission among them
}

}  // namespace
}  // namespace scarf
