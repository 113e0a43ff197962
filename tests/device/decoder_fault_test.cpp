// Every Vulkan call is made to fail once while words are decoded: the error is the right one, and no event is
// lost silently.
#include <gtest/gtest.h>

#include "scarf/device/decoder.h"
#include "scarf/reference/reference.h"
#include "tests/support/faults.h"
#include "tests/support/same.h"
#include "tests/support/words.h"

namespace scarf {
namespace {

using test::Faults;

constexpr SensorSize kSensor = {640, 480};
const test::Bytes kWords = test::random_words(CameraWords::evt3, test::Mixture::plausible, 700, 1);

struct Outcome {
  std::optional<Error> error;  // the first one
  int calls_before = 0;        // the decoder is made: tests/device/fault_test.cpp has those fail
  std::optional<std::vector<uint8_t>> state;
  std::optional<ReadReport> report;
};

// Feeds words in small pieces, asks in between, and goes on after a failure: whatever comes must not crash.
Outcome decode_everything(DeviceOptions::Upload upload) {
  Outcome outcome;
  const auto note = [&](const auto& result) {
    if (!result && !outcome.error) outcome.error = result.error();
    return result.ok();
  };
  const auto context = test::faulty_context(upload);
  if (!note(context)) return outcome;
  auto sae = make_gpu_representation(*context, SaeParameters{}, kSensor, {.submission_events = 200});
  if (!note(sae)) return outcome;
  outcome.calls_before = Faults::calls;
  auto decoder = make_gpu_decoder(**sae, CameraWords::evt3);
  if (!note(decoder)) return outcome;
  const auto all = std::span<const uint8_t>(kWords);
  note((*decoder)->push(all.first(301)));
  note((*sae)->flush());
  note((*decoder)->push(all.subspan(301)));
  // Asked for twice: a failure in front of the first answer leaves the words where they are.
  auto state = (*sae)->state().wait();
  note(state);
  if (!state) state = (*sae)->state().wait();
  const auto report = (*decoder)->report();
  note(report);
  note((*sae)->finish());
  Faults::stop_device = nullptr;
  if (state) outcome.state = *state;
  if (report) outcome.report = *report;
  return outcome;
}

class DecodingFault : public testing::TestWithParam<std::pair<VkResult, DeviceOptions::Upload>> {
 protected:
  void TearDown() override { Faults::arm(0, VK_SUCCESS); }
};

TEST_P(DecodingFault, OfEachCallIsReportedAndLosesNothingSilently) {
  const auto [result, upload] = GetParam();
  Faults::arm(0, VK_SUCCESS);
  const Outcome whole = decode_everything(upload);
  ASSERT_FALSE(whole.error) << whole.error->message;
  const int calls = Faults::calls;
  ASSERT_GT(calls - whole.calls_before, 80);
  const test::Read read = test::read_words(CameraWords::evt3, kWords, kSensor);
  EXPECT_EQ(whole.report, read.report);
  auto reference = *make_reference_representation(SaeParameters{}, kSensor);
  ASSERT_TRUE(reference->push(read.events));
  const std::vector<uint8_t> expected = test::value_of(reference->state());
  EXPECT_EQ(*whole.state, expected);

  int unreported = 0;
  for (int n = whole.calls_before + 1; n <= calls; ++n) {
    SCOPED_TRACE(n);
    Faults::arm(n, result);
    const Outcome outcome = decode_everything(upload);
    unreported += outcome.error ? 0 : 1;
    if (outcome.error) {
      EXPECT_EQ(outcome.error->code, test::reported_as(result)) << outcome.error->message;
    }
    // Whatever was handed out is whole.
    if (outcome.state) {
      EXPECT_EQ(*outcome.state, expected);
    }
    if (outcome.report) {
      EXPECT_EQ(*outcome.report, *whole.report);
    }
  }
  EXPECT_LE(unreported, (calls - whole.calls_before) / 10);
}

INSTANTIATE_TEST_SUITE_P(Results, DecodingFault,
                         testing::Values(std::pair(VK_ERROR_DEVICE_LOST, DeviceOptions::Upload::automatic),
                                         std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                                   DeviceOptions::Upload::transfer_queue)));

}  // namespace
}  // namespace scarf
