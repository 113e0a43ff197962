// The one promise: the device equals the reference bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

class Equivalence : public test::DeviceTest {
 protected:
  // Pushes the stream in batches of random sizes (with empty ones among them), compared after each.
  void compare(const Geometry& geometry, const std::vector<Event>& events, std::mt19937& random,
               const GpuOptions& options = {}) {
    SCOPED_TRACE(to_string(geometry));
    auto device = device_scarf(geometry, options);
    auto reference = reference_scarf(geometry);
    ASSERT_TRUE(device && reference);
    size_t done = 0;
    while (done < events.size()) {
      const size_t n =
          random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % (events.size() / 2));
      const auto batch = std::span(events).subspan(done, n);
      const PushReport a = test::value_of(device->push(batch));
      const PushReport b = test::value_of(reference->push(batch));
      ASSERT_EQ(a.accepted, b.accepted);
      ASSERT_EQ(a.outside, b.outside);
      done += n;
      ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
    }
  }
};

TEST_F(Equivalence, EveryPresetAndSpread) {
  std::mt19937 random(1);
  for (Preset preset : {Preset::paper, Preset::light, Preset::event_driven, Preset::event_driven_flex}) {
    const SensorSize sensor = {97, 61};
    const Geometry geometry = *make_geometry(preset, sensor);
    for (Spread spread : test::kSpreads) {
      SCOPED_TRACE(static_cast<int>(spread));
      ASSERT_NO_FATAL_FAILURE(compare(geometry, make_stream(spread, sensor, 4000, random()), random));
    }
  }
}

TEST_F(Equivalence, RandomGeometries) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const SensorSize sensor = {8 + static_cast<int32_t>(random() % 120),
                               8 + static_cast<int32_t>(random() % 80)};
    const Geometry geometry = test::random_geometry(sensor, random);
    const Spread spread = test::kSpreads[trial % std::size(test::kSpreads)];
    GpuOptions options;
    options.chunk_events = trial % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 700);
    options.submission_events = trial % 3 == 0 ? 1 + static_cast<uint32_t>(random() % 3000) : 0;
    options.bands = trial % 5 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 6);
    options.placing = trial % 4 < 2 ? GpuOptions::Placing::appended : GpuOptions::Placing::automatic;
    ASSERT_NO_FATAL_FAILURE(compare(geometry, make_stream(spread, sensor, 3000, random()), random, options));
  }
}

TEST_F(Equivalence, HeadsOfShortRingsDoNotOverflow) {
  // Every event fills all rings, of one slot each: 150,000 laps of a head that holds 65,535.
  std::mt19937 random(5);
  const SensorSize sensor = {12, 9};
  const Geometry geometry = *checked_geometry({{12, 4, 0, 3, 8, 8}, {9, 3, 0, 3, 6, 6}, 1});
  for (const auto placing : {GpuOptions::Placing::appended, GpuOptions::Placing::chunked}) {
    const GpuOptions options = {.placing = placing};
    auto device = device_scarf(geometry, options);
    auto reference = reference_scarf(geometry);
    for (uint32_t batch = 0; batch < 3; ++batch) {
      const auto events = make_stream(Spread::uniform, sensor, 50'000, batch, batch * 1'000'000);
      ASSERT_TRUE(device->push(events));
      ASSERT_TRUE(reference->push(events));
      ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
    }
    EXPECT_GT(test::value_of(device->snapshot()).totals[4], 65'536u);
  }
}

TEST_F(Equivalence, SmallestSensorAndManyPatchesPerPixel) {
  std::mt19937 random(3);
  const SensorSize sensor = {8, 8};
  ASSERT_NO_FATAL_FAILURE(
      compare(*make_geometry(Preset::paper, sensor), make_stream(Spread::uniform, sensor, 2000, 1), random));
  // 20 x 12 patches hold each pixel: more than any team has lanes.
  const Geometry dense = *checked_geometry({{60, 1, 0, 60, 10, 9}, {40, 2, -3, 22, 11, 11}, 17});
  ASSERT_NO_FATAL_FAILURE(compare(dense, make_stream(Spread::moving_edge, {60, 40}, 1500, 2), random));
}

TEST_F(Equivalence, HighDefinition) {
  std::mt19937 random(4);
  const SensorSize sensor = {1280, 720};
  for (Preset preset : {Preset::paper, Preset::light}) {
    const Geometry geometry = *make_geometry(preset, sensor);
    ASSERT_NO_FATAL_FAILURE(compare(geometry, make_stream(Spread::moving_edge, sensor, 60'000, 3), random));
  }
}

TEST_F(Equivalence, RingLongerThanOneDispatchWalks) {
  std::mt19937 random(5);
  const Geometry geometry = *checked_geometry({{20, 10, 0, 2, 3, 3}, {10, 10, 0, 1, 0, 0}, 65'535});
  ASSERT_NO_FATAL_FAILURE(compare(geometry, make_stream(Spread::uniform, {20, 10}, 150'000, 4), random));
}

TEST_F(Equivalence, MoreEventsInOneTileThanADriverLoopCounts) {
  // 200,000 events of one pixel in one push: see Quirks::loop_trips.
  const Geometry geometry = *make_geometry(Preset::paper, {64, 48});
  const auto events = make_stream(Spread::one_pixel, {64, 48}, 200'000, 5);
  auto device = device_scarf(geometry);
  auto reference = reference_scarf(geometry);
  ASSERT_TRUE(device->push(events) && reference->push(events));
  test::expect_same(*device, *reference);
}

TEST_F(Equivalence, SizesAroundChunksAndCapacity) {
  std::mt19937 random(6);
  const Geometry geometry = *checked_geometry({{30, 5, 0, 6, 4, 4}, {20, 5, 0, 4, 4, 4}, 100});
  GpuOptions options;
  options.chunk_events = 64;
  for (size_t size : {0, 1, 63, 64, 65, 99, 100, 101, 128, 6400, 6401}) {
    auto device = device_scarf(geometry, options);
    auto reference = reference_scarf(geometry);
    for (int batch = 0; batch < 3; ++batch) {
      const auto events = make_stream(Spread::one_pixel, {30, 20}, size, random());
      ASSERT_TRUE(device->push(events) && reference->push(events));
      ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference)) << size;
    }
  }
}

TEST_F(Equivalence, TimesAtTheLimitsComeBackExactly) {
  const Geometry geometry = *make_geometry(Preset::light, {32, 24});
  constexpr int64_t kFar = (int64_t{1} << 48) - 1;
  for (int64_t first :
       {int64_t{0}, int64_t{-5}, int64_t{1'700'000'000'000'000}, INT64_MIN + kFar, INT64_MAX - kFar}) {
    std::vector<Event> events = {
        {first, 1, 1, 1, {}}, {first + kFar, 2, 2, 0, {}}, {first - kFar, 3, 3, 1, {}}};
    auto device = device_scarf(geometry);
    auto reference = reference_scarf(geometry);
    ASSERT_TRUE(device->push(events) && reference->push(events));
    ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
    for (int64_t beyond : {first + kFar + 1, first - kFar - 1}) {
      if ((beyond > first) != (beyond - first > 0)) continue;  // not representable
      const Event bad[] = {{first, 4, 4, 1, {}}, {beyond, 5, 5, 1, {}}};
      const auto a = device->push(bad);
      const auto b = reference->push(bad);
      ASSERT_FALSE(a || b);
      EXPECT_EQ(a.error().code, ErrorCode::refused_batch);
      EXPECT_EQ(a.error().message, b.error().message);
      ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
    }
  }
}

TEST_F(Equivalence, ResetStartsANewStream) {
  const SensorSize sensor = {50, 40};
  const Geometry geometry = *make_geometry(Preset::paper, sensor);
  auto device = device_scarf(geometry);
  auto reference = reference_scarf(geometry);
  for (int64_t t_begin : {int64_t{0}, int64_t{1} << 60, -(int64_t{1} << 60)}) {
    const auto events = make_stream(Spread::uniform, sensor, 3000, 9, t_begin);
    ASSERT_TRUE(device->push(events) && reference->push(events));
    ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
    ASSERT_TRUE(device->push(events));  // gathered, not yet submitted
    ASSERT_TRUE(device->reset() && reference->reset());
    ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
  }
}

// Every way in which a stream may be cut and carried gives the same bytes.
class UploadEquivalence : public Equivalence, public testing::WithParamInterface<DeviceOptions::Upload> {
 protected:
  void SetUp() override { open(test::checked_options(GetParam())); }
};

TEST_P(UploadEquivalence, CutsSlotsAndChunksNeverChangeAByte) {
  const SensorSize sensor = {120, 90};
  const Geometry geometry = *make_geometry(Preset::paper, sensor);
  const auto events = make_stream(Spread::moving_edge, sensor, 20'000, 11);
  auto reference = reference_scarf(geometry);
  ASSERT_TRUE(reference->push(events));
  std::mt19937 random(12);
  for (uint32_t slots : {1u, 2u, 5u}) {
    for (uint32_t chunk_events : {0u, 1u << 7, 1u << 15}) {
      for (uint32_t submission : {0u, 1000u, 7777u}) {
        GpuOptions options;
        options.staging_slots = slots;
        options.chunk_events = chunk_events;
        options.submission_events = submission;
        options.bands = slots;
        options.placing = chunk_events == 0 ? GpuOptions::Placing::appended : GpuOptions::Placing::automatic;
        auto device = device_scarf(geometry, options);
        for (size_t done = 0; done < events.size();) {
          const size_t n = std::min<size_t>(events.size() - done, 1 + random() % 6000);
          ASSERT_TRUE(device->push(std::span(events).subspan(done, n)));
          if (random() % 3 == 0) {
            ASSERT_TRUE(device->flush());
          }
          done += n;
        }
        ASSERT_NO_FATAL_FAILURE(test::expect_same(*device, *reference));
      }
    }
  }
}

TEST_P(UploadEquivalence, EventsMayBeWrittenInPlace) {
  const SensorSize sensor = {120, 90};
  const Geometry geometry = *make_geometry(Preset::light, sensor);
  const auto events = make_stream(Spread::beyond, sensor, 10'000, 13);
  auto reference = reference_scarf(geometry);
  GpuOptions options;
  options.submission_events = 1500;
  auto device = device_scarf(geometry, options);
  std::mt19937 random(14);
  for (size_t done = 0; done < events.size();) {
    const size_t n = std::min<size_t>(events.size() - done, random() % 1500);
    const std::span<Event> memory = test::value_of(device->acquire(n));
    ASSERT_EQ(memory.size(), n);
    // A query between acquire and commit sees what was pushed before.
    if (random() % 4 == 0) {
      ASSERT_NO_FATAL_FAILURE(test::expect_same_state(*device, *reference));
    }
    std::copy_n(events.begin() + static_cast<std::ptrdiff_t>(done), n, memory.begin());
    const auto report = device->commit(n);
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(reference->push(std::span(events).subspan(done, n)));
    done += n;
  }
  test::expect_same(*device, *reference);
}

std::string upload_name(const testing::TestParamInfo<DeviceOptions::Upload>& upload) {
  switch (upload.param) {
    case DeviceOptions::Upload::automatic:
      return "Automatic";
    case DeviceOptions::Upload::staged:
      return "Staged";
    case DeviceOptions::Upload::transfer_queue:
      return "TransferQueue";
  }
  return "Unknown";
}

INSTANTIATE_TEST_SUITE_P(Paths, UploadEquivalence,
                         testing::Values(DeviceOptions::Upload::automatic, DeviceOptions::Upload::staged,
                                         DeviceOptions::Upload::transfer_queue),
                         upload_name);

}  // namespace
}  // namespace scarf
