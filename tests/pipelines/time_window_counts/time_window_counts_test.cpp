// time_window with counts on the device: what the tests of all representations do not reach.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

class TimeWindowCounts : public test::DeviceTest {
 protected:
  void make(const TimeWindowParameters& parameters, SensorSize sensor, const GpuOptions& options = {}) {
    device_ = test::value_of(make_gpu_representation(context_, parameters, sensor, options));
    reference_ = test::value_of(make_reference_representation(parameters, sensor));
    ASSERT_TRUE(device_ && reference_);
  }
  void push(std::span<const Event> events) { ASSERT_TRUE(device_->push(events) && reference_->push(events)); }
  void compare(std::optional<int64_t> now = {}) {
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device_, *reference_, now));
  }

  std::unique_ptr<GpuRepresentation> device_;
  std::unique_ptr<Representation> reference_;
};

// Far more events than the log has room for at first; those of the window are few, then many.
TEST_F(TimeWindowCounts, DropsAndGrows) {
  std::mt19937 random(1);
  for (int64_t window : {1'000, 300'000}) {
    GpuOptions options;
    options.submission_events = 30'000;
    make({.window = window, .counts = true}, {64, 48}, options);
    int64_t t = 0;
    for (int batch = 0; batch < 6; ++batch) {
      const auto events = make_stream(Spread::moving_edge, {64, 48}, 30'000, random(), t);
      t = events.back().t;
      ASSERT_NO_FATAL_FAILURE(push(events));
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

// Counts beyond the table of brightness: 100,000 events on one pixel.
TEST_F(TimeWindowCounts, ManyEventsOnOnePixel) {
  for (double accumulation : {1e-7, 0.003, 0.1, 1e300}) {
    make({.window = 10'000'000, .counts = true, .accumulation = accumulation}, {5, 3});
    ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::one_pixel, {5, 3}, 100'000, 2)));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

TEST_F(TimeWindowCounts, TinySensorsAndTimesAtTheLimits) {
  constexpr int64_t kFar = (int64_t{1} << 48) - 1;
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{3, 1}, SensorSize{1, 2}, SensorSize{7, 5}}) {
    for (int64_t first : {int64_t{0}, INT64_MIN, INT64_MAX - kFar, INT64_MAX}) {
      make({.window = 3, .counts = true, .accumulation = 0.4}, sensor);
      ASSERT_NO_FATAL_FAILURE(compare(INT64_MAX));
      const int64_t step = first == INT64_MAX ? -1 : 1;
      for (int i = 0; i < 8; ++i) {
        const Event e[] = {{first + i * step, 0, 0, 1, {}}};
        ASSERT_NO_FATAL_FAILURE(push(e));
        ASSERT_NO_FATAL_FAILURE(compare());
      }
      for (int64_t now : {INT64_MIN, INT64_MAX, first, int64_t{5}}) {
        ASSERT_NO_FATAL_FAILURE(compare(now));
      }
    }
  }
}

// Some events were offered and refused because all slots were in flight: their times do not count.
TEST_F(TimeWindowCounts, RefusedEventsDoNotMoveTheWindow) {
  GpuOptions options;
  options.when_full = GpuOptions::WhenFull::would_block;
  options.staging_slots = 1;
  options.submission_events = 2'000;
  make({.window = 500, .counts = true}, {64, 48}, options);
  std::mt19937 random(3);
  int64_t t = 0;
  for (int batch = 0; batch < 40; ++batch) {
    const auto events = make_stream(Spread::uniform, {64, 48}, 7'000, random(), t);
    const auto report = device_->push(events);
    if (!report) {
      ASSERT_EQ(report.error().code, ErrorCode::would_block);
      continue;
    }
    ASSERT_TRUE(reference_->push(std::span(events).first(report->accepted)));
    t = events[report->accepted - 1].t;
  }
  compare();
}

}  // namespace
}  // namespace scarf
