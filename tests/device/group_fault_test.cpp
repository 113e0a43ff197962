// Every Vulkan call of a group is made to fail once: no member loses anything silently.
#include <gtest/gtest.h>

#include "scarf/device/group.h"
#include "scarf/reference/reference.h"
#include "tests/support/faults.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Faults;

constexpr size_t kMembers = 2;
constexpr SensorSize kSensor = {40, 30};

std::vector<Event> events_of(size_t member) {
  return test::make_stream(test::Spread::uniform, kSensor, 900, member);
}

struct Outcome {
  std::optional<Error> error;  // the first one
  int calls_before = 0;        // members are made: fault_test.cpp has those fail
  std::optional<std::vector<Image<uint8_t>>> images;
  std::optional<std::vector<uint8_t>> states[kMembers];
};

// Pushes, flushes and asks, and goes on after a failure: whatever comes must not crash.
Outcome use_group(DeviceOptions::Upload upload) {
  Outcome outcome;
  const auto note = [&](const auto& result) {
    if (!result && !outcome.error) outcome.error = result.error();
    return result.ok();
  };
  const auto context = test::faulty_context(upload);
  if (!note(context)) return outcome;
  const auto group = make_gpu_group(*context);
  std::vector<std::unique_ptr<GpuRepresentation>> members;
  for (size_t i = 0; i < kMembers; ++i) {
    // The first one's slots are full before the group is flushed.
    auto sae = make_gpu_representation(*context, SaeParameters{}, kSensor,
                                       {.submission_events = i == 0 ? 400u : 0u});
    if (!note(sae) || !note(group->add(**sae))) return outcome;
    members.push_back(std::move(*sae));
  }
  outcome.calls_before = Faults::calls;
  for (const size_t half : {0, 1}) {
    for (size_t i = 0; i < kMembers; ++i)
      note(members[i]->push(std::span<const Event>(events_of(i)).subspan(half * 450, 450)));
    if (half == 0) note(group->flush());
  }
  // Asked for twice: a failure in front of the first answer leaves the events where they are.
  auto images = group->u8_images().wait();
  note(images);
  if (!images) images = group->u8_images().wait();
  note(group->finish());
  for (size_t i = 0; i < kMembers; ++i) {
    auto state = members[i]->state().wait();
    note(state);
    if (state) outcome.states[i] = *std::move(state);
  }
  Faults::stop_device = nullptr;
  if (images) outcome.images = *std::move(images);
  return outcome;
}

class GroupFault : public testing::TestWithParam<std::pair<VkResult, DeviceOptions::Upload>> {
 protected:
  void TearDown() override { Faults::arm(0, VK_SUCCESS); }
};

TEST_P(GroupFault, OfEachCallIsReportedAndLosesNothingSilently) {
  const auto [result, upload] = GetParam();
  Faults::arm(0, VK_SUCCESS);
  const Outcome whole = use_group(upload);
  ASSERT_FALSE(whole.error) << whole.error->message;
  const int calls = Faults::calls;
  ASSERT_GT(calls - whole.calls_before, 30);
  std::vector<std::vector<uint8_t>> expected;
  for (size_t i = 0; i < kMembers; ++i) {
    auto reference = *make_reference_representation(SaeParameters{}, kSensor);
    ASSERT_TRUE(reference->push(events_of(i)));
    expected.push_back(test::value_of(reference->state()));
    ASSERT_EQ(*whole.states[i], expected[i]);
    ASSERT_EQ(whole.images->at(i), test::value_of(reference->u8_image()));
  }

  int unreported = 0;
  for (int n = whole.calls_before + 1; n <= calls; ++n) {
    SCOPED_TRACE(n);
    Faults::arm(n, result);
    const Outcome outcome = use_group(upload);
    unreported += outcome.error ? 0 : 1;
    if (outcome.error) {
      EXPECT_EQ(outcome.error->code, test::reported_as(result)) << outcome.error->message;
    }
    // Whatever was handed out is whole.
    for (size_t i = 0; i < kMembers; ++i) {
      if (outcome.states[i]) {
        EXPECT_EQ(*outcome.states[i], expected[i]);
      }
    }
    if (outcome.images) {
      EXPECT_EQ(*outcome.images, *whole.images);
    }
  }
  // Only timestamps, and polls for the next slot: one for each submitted member.
  EXPECT_LE(unreported, (calls - whole.calls_before) / 5);
}

INSTANTIATE_TEST_SUITE_P(
    Results, GroupFault,
    testing::Values(std::pair(VK_ERROR_DEVICE_LOST, DeviceOptions::Upload::automatic),
                    std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY, DeviceOptions::Upload::automatic),
                    std::pair(VK_ERROR_OUT_OF_HOST_MEMORY, DeviceOptions::Upload::transfer_queue)));

}  // namespace
}  // namespace scarf
