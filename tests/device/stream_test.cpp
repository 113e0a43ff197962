// Threads, flow control, several streams, and results that outlive their stream.
#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>

#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;
using test::value_of;

class Stream : public test::DeviceTest {};

TEST_F(Stream, QueriesOfOtherThreadsSeeWholePushes) {
  // One patch holds every pixel, so its total tells how many events a query saw.
  const Geometry geometry = *checked_geometry({{16, 16, 0, 1, 0, 0}, {16, 16, 0, 1, 0, 0}, 50});
  constexpr uint64_t kBatch = 700;
  constexpr uint64_t kBatches = 60;
  const auto events = make_stream(Spread::uniform, {16, 16}, kBatch, 1);
  GpuOptions options;
  options.submission_events = 300;  // every push is split
  auto device = device_scarf(geometry, options);
  std::atomic<uint64_t> returned = 0;
  std::atomic<bool> done = false;
  const auto query = [&] {
    uint64_t last = 0;
    while (!done) {
      const uint64_t before = returned;
      const Snapshot s = value_of(device->snapshot());
      ASSERT_EQ(s.totals.at(0) % kBatch, 0u);
      ASSERT_GE(s.totals[0], before * kBatch);
      ASSERT_GE(s.totals[0], last);
      last = s.totals[0];
      // From the first push on the ring is full.
      const auto image = value_of(device->count_image());
      const int32_t shown = std::accumulate(image.pixels.begin(), image.pixels.end(), 0);
      ASSERT_TRUE(shown == geometry.capacity || (shown == 0 && last == 0)) << shown;
    }
  };
  std::thread first(query);
  std::thread second(query);
  for (uint64_t i = 0; i < kBatches; ++i) {
    ASSERT_TRUE(device->push(events));
    ++returned;
  }
  done = true;
  first.join();
  second.join();
  EXPECT_EQ(value_of(device->snapshot()).totals[0], kBatch * kBatches);
}

TEST_F(Stream, PendingResultsOutliveTheirStreamAndMayBeDropped) {
  const Geometry geometry = *make_geometry(Preset::paper, {100, 80});
  const auto events = make_stream(Spread::uniform, {100, 80}, 5000, 2);
  auto device = device_scarf(geometry);
  auto reference = reference_scarf(geometry);
  ASSERT_TRUE(device->push(events) && reference->push(events));
  for (int i = 0; i < 50; ++i) {
    (void)device->u8_image();
    (void)device->active_events();
  }
  auto image = device->u8_image();
  auto list = device->active_events();
  device.reset();
  EXPECT_EQ(value_of(std::move(image)), value_of(reference->u8_image()));
  EXPECT_EQ(value_of(std::move(list)), value_of(reference->active_events()));
}

TEST_F(Stream, ManyResultsInFlightStayApart) {
  const Geometry geometry = *make_geometry(Preset::light, {64, 64});
  auto device = device_scarf(geometry);
  auto reference = reference_scarf(geometry);
  std::vector<Pending<Image<uint8_t>>> images;
  std::vector<Image<uint8_t>> expected;
  for (uint64_t i = 0; i < 40; ++i) {
    const auto events = make_stream(Spread::moving_edge, {64, 64}, 100, i);
    ASSERT_TRUE(device->push(events) && reference->push(events));
    images.push_back(device->u8_image());
    expected.push_back(value_of(reference->u8_image()));
  }
  for (size_t i = 0; i < images.size(); ++i) EXPECT_EQ(value_of(std::move(images[i])), expected[i]) << i;
}

TEST_F(Stream, StreamsOfOneContextDoNotMix) {
  struct One {
    std::unique_ptr<GpuScarf> device;
    std::unique_ptr<Scarf> reference;
    std::vector<Event> events;
  };
  std::vector<One> streams;
  for (Preset preset : {Preset::paper, Preset::light, Preset::event_driven}) {
    const SensorSize sensor = {60, 50};
    const Geometry g = *make_geometry(preset, sensor);
    streams.push_back(
        {device_scarf(g), reference_scarf(g), make_stream(Spread::uniform, sensor, 6000, streams.size())});
  }
  std::vector<std::thread> threads;
  for (One& one : streams) {
    threads.emplace_back([&one] {
      for (size_t i = 0; i < one.events.size(); i += 500) {
        const auto batch = std::span(one.events).subspan(i, 500);
        ASSERT_TRUE(one.device->push(batch) && one.reference->push(batch));
        ASSERT_NO_FATAL_FAILURE(test::expect_same_state(*one.device, *one.reference));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (One& one : streams) test::expect_same(*one.device, *one.reference);
}

TEST_F(Stream, WouldBlockTakesAPartAndLosesNothing) {
  const Geometry geometry = *make_geometry(Preset::paper, {80, 60});
  const auto events = make_stream(Spread::beyond, {80, 60}, 30'000, 3);
  auto reference = reference_scarf(geometry);
  const PushReport whole = value_of(reference->push(events));
  GpuOptions options;
  options.when_full = GpuOptions::WhenFull::would_block;
  options.staging_slots = 2;
  options.submission_events = 1000;
  auto device = device_scarf(geometry, options);
  size_t done = 0;
  uint64_t outside = 0;
  size_t blocked = 0;
  while (done < events.size()) {
    const auto report = device->push(std::span(events).subspan(done));
    if (!report) {
      ASSERT_EQ(report.error().code, ErrorCode::would_block) << report.error().message;
      ++blocked;
      std::this_thread::yield();
      continue;
    }
    ASSERT_GT(report->accepted, 0u);
    if (report->accepted < events.size() - done) ++blocked;
    done += report->accepted;
    outside += report->outside;
  }
  EXPECT_GT(blocked, 0u);
  EXPECT_EQ(outside, whole.outside);
  test::expect_same(*device, *reference);
}

TEST_F(Stream, AcquireAndCommitRefuseMisuse) {
  auto device = device_scarf(*make_geometry(Preset::paper, {80, 60}));
  const Event event = {0, 1, 1, 1, {}};
  EXPECT_FALSE(device->commit(1));
  EXPECT_FALSE(device->acquire(device->max_acquire() + 1));
  ASSERT_TRUE(device->acquire(10));
  EXPECT_FALSE(device->acquire(10));
  EXPECT_FALSE(device->push(std::span(&event, 1)));
  EXPECT_FALSE(device->commit(11));
}

TEST_F(Stream, RefusedCommitStoresNothing) {
  const Geometry geometry = *make_geometry(Preset::paper, {80, 60});
  auto device = device_scarf(geometry);
  auto reference = reference_scarf(geometry);
  const std::span<Event> memory = value_of(device->acquire(2));
  memory[0] = {5, 1, 1, 1, {}};
  memory[1] = {5, 1, 1, 2, {}};
  const auto report = device->commit(2);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::refused_batch);
  test::expect_same(*device, *reference);
}

TEST_F(Stream, AStateBeyondTheDeviceIsRefusedByName) {
  const uint64_t limit = context_->device().memory;
  const Geometry geometry = *checked_geometry({{1280, 2, 0, 640, 0, 0}, {720, 2, 0, 360, 0, 0}, 65'535});
  const auto made = make_gpu_scarf(context_, geometry);
  if (made) GTEST_SKIP() << "this device holds 120 GB (" << limit << " bytes)";
  EXPECT_EQ(made.error().code, ErrorCode::out_of_memory);
  EXPECT_NE(made.error().message.find("ring buffers"), std::string::npos) << made.error().message;
}

TEST_F(Stream, StagesAreTimedAndMemoryIsCounted) {
  const Geometry geometry = *make_geometry(Preset::paper, {80, 60});
  auto device = device_scarf(geometry, {.placing = GpuOptions::Placing::chunked});
  ASSERT_TRUE(device->push(make_stream(Spread::uniform, {80, 60}, 5000, 4)));
  value_of(device->u8_planes(PolarityMode::separate));
  std::vector<std::string> stages;
  for (const StageTime& time : device->stage_times()) {
    stages.push_back(time.stage);
    EXPECT_GT(time.dispatches, 0u);
  }
  for (const char* stage : {"count", "scan", "place", "render", "tone"}) {
    EXPECT_TRUE(std::find(stages.begin(), stages.end(), stage) != stages.end()) << stage;
  }
  EXPECT_GT(device->memory_bytes(), uint64_t{80 * 60 * 4});
}

}  // namespace
}  // namespace scarf
