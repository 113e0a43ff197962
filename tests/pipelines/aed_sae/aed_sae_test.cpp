// AED-SAE on the device. Its list and last times are the reference's; its picture may differ by one 8-bit
// level in one pixel of a thousand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

class AedSae : public test::DeviceTest {
 protected:
  void make(const AedSaeParameters& parameters, SensorSize sensor, const GpuOptions& options = {}) {
    device_ = test::value_of(make_gpu_representation(context_, parameters, sensor, options));
    reference_ = test::value_of(make_reference_representation(parameters, sensor));
    ASSERT_TRUE(device_ && reference_);
  }
  void push(std::span<const Event> events) { ASSERT_TRUE(device_->push(events) && reference_->push(events)); }

  void compare_state() {
    ASSERT_EQ(test::value_of(device_->state()), test::value_of(reference_->state()));
    ASSERT_EQ(test::value_of(device_->raw_image()), test::value_of(reference_->raw_image()));
  }

  void compare() {
    ASSERT_NO_FATAL_FAILURE(compare_state());
    const auto a = test::u8_of(*device_);
    const auto b = test::u8_of(*reference_);
    ASSERT_EQ(a.size(), b.size());
    size_t differing = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      ASSERT_LE(std::abs(a[i] - b[i]), 1) << "pixel " << i;
      differing += a[i] != b[i];
    }
    EXPECT_LE(differing, a.size() / 1000);
    // Far stricter: a single pixel more or less above the threshold would show.
    const auto fa = test::float_of(*device_);
    const auto fb = test::float_of(*reference_);
    for (size_t i = 0; i < fa.size(); ++i) ASSERT_NEAR(fa[i], fb[i], 1e-6) << "pixel " << i;
    ASSERT_NO_FATAL_FAILURE(compare_state());
    EXPECT_EQ(device_->events().wait().error().message, reference_->events().wait().error().message);
  }

  void feed(const std::vector<Event>& events, std::mt19937& random, size_t most) {
    for (size_t done = 0; done < events.size();) {
      const size_t n = random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % most);
      ASSERT_NO_FATAL_FAILURE(push(std::span(events).subspan(done, n)));
      done += n;
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }

  std::unique_ptr<GpuRepresentation> device_;
  std::unique_ptr<Representation> reference_;
};

TEST_F(AedSae, EverySpread) {
  std::mt19937 random(1);
  const AedSaeParameters variants[] = {
      {}, {.window = 1'000, .lambda = 2.5}, {.window = 100'000'000, .lambda = 1e-3}};
  int which = 0;
  for (const Spread spread : test::kSpreads) {
    SCOPED_TRACE(static_cast<int>(spread));
    GpuOptions options;
    options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 1500);
    const SensorSize sensor = {61, 37};
    make(variants[which++ % std::size(variants)], sensor, options);
    ASSERT_NO_FATAL_FAILURE(feed(make_stream(spread, sensor, 4000, random()), random, 2000));
  }
}

TEST_F(AedSae, TinyAndOddSensors) {
  std::mt19937 random(2);
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{2, 1}, SensorSize{1, 5}, SensorSize{3, 4},
                                  SensorSize{8, 8}, SensorSize{9, 7}, SensorSize{50, 2}}) {
    make({.window = 1'000}, sensor);
    ASSERT_NO_FATAL_FAILURE(feed(make_stream(Spread::beyond, sensor, 600, random()), random, 300));
  }
}

// The times of a stream with forward and backward jumps of all sizes.
std::vector<Event> jumping(SensorSize sensor, size_t count, int64_t window, uint32_t one_in,
                           std::mt19937& random) {
  std::vector<Event> events = make_stream(Spread::uniform, sensor, count, random());
  int64_t t = 0;
  for (Event& e : events) {
    t += random() % 5;
    if (random() % one_in == 0) {
      const auto jump = static_cast<int64_t>(random() % static_cast<uint64_t>(window * 5 / 2));
      t += random() % 2 == 0 ? jump : -jump;
    }
    e.t = t;
    // A few events out of order, the list goes on.
    if (random() % 16 == 0) e.t -= static_cast<int64_t>(random() % static_cast<uint64_t>(window));
  }
  return events;
}

TEST_F(AedSae, ClearsWhereAnEventIsOlderThanTheFront) {
  std::mt19937 random(3);
  const SensorSize sensor = {40, 30};
  for (uint32_t one_in : {1u, 3u, 30u, 1000u}) {
    for (uint32_t submission : {0u, 1u + static_cast<uint32_t>(random() % 500)}) {
      GpuOptions options;
      options.submission_events = submission;
      make({.window = 1'000}, sensor, options);
      const auto events = jumping(sensor, 3000, 1'000, one_in, random);
      for (size_t done = 0; done < events.size();) {
        const size_t n = std::min(events.size() - done, 1 + random() % 700);
        ASSERT_NO_FATAL_FAILURE(push(std::span(events).subspan(done, n)));
        done += n;
        ASSERT_NO_FATAL_FAILURE(compare_state());
      }
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

// Every event clears the list: more than one dispatch looks at.
TEST_F(AedSae, TimesThatOnlyFall) {
  const SensorSize sensor = {40, 30};
  make({}, sensor);
  std::vector<Event> events = make_stream(Spread::uniform, sensor, 100'000, 4);
  for (size_t i = 0; i < events.size(); ++i) events[i].t = -static_cast<int64_t>(i);
  ASSERT_NO_FATAL_FAILURE(push(events));
  ASSERT_NO_FATAL_FAILURE(compare());
  ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::uniform, sensor, 1'000, 5)));
  ASSERT_NO_FATAL_FAILURE(compare());
}

TEST_F(AedSae, TimesAtTheLimits) {
  constexpr int64_t kFar = (int64_t{1} << 48) - 1;
  for (int64_t first : {INT64_MIN, INT64_MIN + 500, INT64_MAX - kFar, INT64_MAX}) {
    make({.window = 1'000}, {5, 4});
    const int64_t step = first == INT64_MAX ? -1 : 1;
    std::vector<Event> events;
    for (int i = 0; i < 40; ++i) {
      events.push_back(
          {first + step * (i % 7) * 300, static_cast<uint16_t>(i % 5), static_cast<uint16_t>(i % 4), 1, {}});
    }
    ASSERT_NO_FATAL_FAILURE(push(events));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

// Far more events than the log has room for at first; those of the list are few, then many.
TEST_F(AedSae, DropsAndGrows) {
  std::mt19937 random(6);
  const SensorSize sensor = {64, 48};
  for (int64_t window : {1'000, 300'000}) {
    GpuOptions options;
    options.submission_events = 30'000;
    make({.window = window}, sensor, options);
    int64_t t = 0;
    for (int batch = 0; batch < 6; ++batch) {
      auto events = make_stream(Spread::moving_edge, sensor, 30'000, random(), t);
      t = events.back().t;
      // Back, but not beyond the front.
      for (size_t i = 100; i < events.size(); i += 97) events[i].t -= static_cast<int64_t>(random() % 90);
      ASSERT_NO_FATAL_FAILURE(push(events));
      ASSERT_NO_FATAL_FAILURE(compare_state());
    }
    ASSERT_NO_FATAL_FAILURE(compare());
    const auto late = jumping(sensor, 5000, window, 100, random);
    ASSERT_NO_FATAL_FAILURE(push(late));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

TEST_F(AedSae, CameraSizes) {
  std::mt19937 random(7);
  for (const SensorSize sensor : {SensorSize{240, 180}, SensorSize{346, 260}}) {
    make({}, sensor);
    ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::moving_edge, sensor, 30'000, random())));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

TEST_F(AedSae, ResetStartsANewStream) {
  const SensorSize sensor = {50, 40};
  make({}, sensor);
  for (int64_t t_begin : {int64_t{0}, int64_t{1} << 60, -(int64_t{1} << 60)}) {
    const auto events = make_stream(Spread::moving_edge, sensor, 3000, 9, t_begin);
    ASSERT_NO_FATAL_FAILURE(push(events));
    ASSERT_NO_FATAL_FAILURE(compare());
    ASSERT_TRUE(device_->push(events));
    ASSERT_TRUE(device_->reset() && reference_->reset());
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

}  // namespace
}  // namespace scarf
