// CHAIN-SAE on the device: what the tests of all representations do not reach.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <random>

#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

class ChainSae : public test::DeviceTest, public testing::WithParamInterface<ChainSaeParameters::Rule> {
 protected:
  void make(SensorSize sensor, const GpuOptions& options = {}) {
    const ChainSaeParameters parameters{.rule = GetParam()};
    device_ = test::value_of(make_gpu_representation(context_, parameters, sensor, options));
    reference_ = test::value_of(make_reference_representation(parameters, sensor));
    ASSERT_TRUE(device_ && reference_);
  }

  void push(std::span<const Event> events) { ASSERT_TRUE(device_->push(events) && reference_->push(events)); }
  void compare() { ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device_, *reference_)); }

  std::unique_ptr<GpuRepresentation> device_;
  std::unique_ptr<Representation> reference_;
};

TEST_P(ChainSae, TinyAndOddSensors) {
  std::mt19937 random(1);
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{2, 1}, SensorSize{1, 3}, SensorSize{5, 7}}) {
    make(sensor);
    for (size_t size : {0, 1, 2, 3, 40, 500}) {
      push(make_stream(Spread::beyond, sensor, size, random()));
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

// So many events that the stamps are renumbered again and again, with and without queries in between.
TEST_P(ChainSae, Renumbering) {
  std::mt19937 random(2);
  const SensorSize sensor = {19, 11};
  GpuOptions options;
  options.submission_events = 100;
  make(sensor, options);
  for (int batch = 0; batch < 60; ++batch) {
    const Spread spread = test::kSpreads[random() % std::size(test::kSpreads)];
    push(make_stream(spread, sensor, random() % 600, random()));
    if (random() % 4 == 0) {
      ASSERT_NO_FATAL_FAILURE(compare());
    }
    if (random() % 20 == 0) {
      ASSERT_TRUE(device_->reset() && reference_->reset());
    }
  }
  ASSERT_NO_FATAL_FAILURE(compare());
}

// A pixel that is not on the newest picture keeps its place for as long as it takes.
TEST_P(ChainSae, PixelsThatFiredLongAgo) {
  const SensorSize sensor = {8, 8};
  GpuOptions options;
  options.submission_events = 64;
  make(sensor, options);
  push(make_stream(Spread::uniform, sensor, 300, 3));
  for (int batch = 0; batch < 40; ++batch) push(make_stream(Spread::one_pixel, sensor, 100, batch));
  ASSERT_NO_FATAL_FAILURE(compare());
}

TEST_P(ChainSae, HotPixelAndManyEventsInOnePush) {
  const SensorSize sensor = {64, 48};
  make(sensor);
  push(make_stream(Spread::uniform, sensor, 2000, 4));
  push(make_stream(Spread::one_pixel, sensor, 200'000, 5));
  ASSERT_NO_FATAL_FAILURE(compare());
}

TEST_P(ChainSae, HighDefinition) {
  const SensorSize sensor = {1280, 720};
  make(sensor);
  for (int batch = 0; batch < 3; ++batch) {
    push(make_stream(Spread::moving_edge, sensor, 50'000, batch));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

TEST_P(ChainSae, ASensorThatIsTooLargeIsRefusedBeforeItsTableIsMade) {
  const SensorSize sensor{16'384, 16'384};
  const uint64_t pixels = uint64_t{16'384} * 16'384;
  if (context_->vulkan().limits().storage_range >= pixels * sizeof(uint32_t)) {
    GTEST_SKIP() << "the device can hold it";
  }
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // KiB
  };
  const long before = peak();
  const auto made =
      make_gpu_representation(context_, ChainSaeParameters{.rule = GetParam()}, sensor, GpuOptions{});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("the stamps of the pixels needs"), std::string::npos);
  EXPECT_LT(peak() - before, 512 * 1024) << "the table has two gigabytes";
}

INSTANTIATE_TEST_SUITE_P(
    Rules, ChainSae, testing::Values(ChainSaeParameters::Rule::paper, ChainSaeParameters::Rule::event_driven),
    [](const auto& rule) { return rule.param == ChainSaeParameters::Rule::paper ? "Paper" : "EventDriven"; });

}  // namespace
}  // namespace scarf
