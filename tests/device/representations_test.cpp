// The one promise, for every representation that has it: the device equals the reference bit for bit.
#include "tests/support/representations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/context.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Case;
using test::make_stream;
using test::Spread;

std::vector<Case> exact_cases() {
  std::vector<Case> cases = test::representation_cases();
  std::erase_if(cases, [](const Case& c) { return !info_of(c.parameters).exact; });
  return cases;
}

class RepresentationEquivalence : public test::DeviceTest, public testing::WithParamInterface<Case> {
 protected:
  // Pushes the stream in batches of random sizes (with empty ones among them), compared after each.
  void compare(SensorSize sensor, const std::vector<Event>& events, std::mt19937& random,
               const GpuOptions& options = {}) {
    const auto device = make_gpu_representation(context_, GetParam().parameters, sensor, options);
    ASSERT_TRUE(device) << device.error().message;
    const auto reference = make_reference_representation(GetParam().parameters, sensor);
    ASSERT_TRUE(reference) << reference.error().message;
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(**device, **reference));
    ASSERT_NO_FATAL_FAILURE(feed(**device, **reference, events, random));
    ASSERT_TRUE((*device)->reset() && (*reference)->reset());
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(**device, **reference));
    const auto half = std::span(events).last(events.size() / 2);
    ASSERT_TRUE((*device)->push(half) && (*reference)->push(half));
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(**device, **reference));
  }

  static void feed(Representation& device, Representation& reference, std::span<const Event> events,
                   std::mt19937& random) {
    size_t done = 0;
    while (done < events.size()) {
      const size_t n =
          random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % (events.size() / 2));
      const auto batch = events.subspan(done, n);
      const PushReport a = test::value_of(device.push(batch));
      const PushReport b = test::value_of(reference.push(batch));
      ASSERT_EQ(a.accepted, b.accepted);
      ASSERT_EQ(a.outside, b.outside);
      done += n;
      // In between a time that is asked for, before and after the newest event.
      std::optional<int64_t> now;
      if (random() % 2 == 0) now = static_cast<int64_t>(random() % 9000) - 500;
      ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(device, reference, now));
    }
  }
};

TEST_P(RepresentationEquivalence, EverySpread) {
  std::mt19937 random(1);
  for (Spread spread : test::kSpreads) {
    SCOPED_TRACE(static_cast<int>(spread));
    GpuOptions options;
    options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 1500);
    const SensorSize sensor = {61, 37};
    ASSERT_NO_FATAL_FAILURE(compare(sensor, make_stream(spread, sensor, 2000, random()), random, options));
  }
}

TEST_P(RepresentationEquivalence, OtherSensors) {
  std::mt19937 random(2);
  for (const SensorSize sensor : {SensorSize{20, 20}, SensorSize{21, 64}, SensorSize{130, 23}}) {
    ASSERT_NO_FATAL_FAILURE(
        compare(sensor, make_stream(Spread::moving_edge, sensor, 1500, random()), random));
  }
}

INSTANTIATE_TEST_SUITE_P(All, RepresentationEquivalence, testing::ValuesIn(exact_cases()),
                         [](const auto& c) { return c.param.label; });

}  // namespace
}  // namespace scarf
