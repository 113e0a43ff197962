// Events that are packed on the host and unpacked by the shader and by its twin.
#include "layout/event_packer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "cpu_ref/stages/decode/unpack_events.h"
#include "device/stream.h"
#include "kernels/event_unpacker.h"
#include "kernels/pipeline.h"
#include "tests/support/context.h"
#include "tests/support/event_recorder.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"
#include "tests/support/words.h"

namespace scarf {
namespace {

constexpr uint32_t kMostEvents = 3000;
constexpr SensorSize kHd = {1280, 720};
constexpr SensorSize kLargest = {16'384, 16'384};

// A packer with memory of its own.
struct Packing {
  explicit Packing(SensorSize sensor, uint32_t most_events = kMostEvents)
      : memory(EventPacker::memory_words(most_events), 0xA5A5A5A5),
        packer(sensor, memory.data(), most_events) {}

  std::vector<Event> unpacked() {
    const auto part = packer.part();
    std::vector<Event> events(part.push.events);
    stages::unpack_events(memory, events, part.push);
    return events;
  }

  std::vector<uint32_t> memory;
  EventPacker packer;
};

std::vector<Event> steps(SensorSize sensor, size_t count, int64_t step, int64_t t = 0) {
  std::vector<Event> events = test::make_stream(test::Spread::uniform, sensor, count, 1);
  for (Event& e : events) e.t = t += step;
  return events;
}

void expect_lossless(SensorSize sensor, const std::vector<Event>& events, size_t bytes_per_256) {
  Packing packing(sensor);
  packing.packer.append(events);
  EXPECT_EQ(packing.unpacked(), events);
  const auto part = packing.packer.part();
  EXPECT_EQ(part.table_words, (events.size() + 255) / 256 * 3);
  if (bytes_per_256 != 0) {
    EXPECT_EQ(part.data_words * 4, events.size() / 256 * bytes_per_256);
  }
}

TEST(EventPacker, TakesTheFewestBytesThatHoldTheTimesOfABlock) {
  // 10 bits of a word are for times at 1280x720: 255 steps of 4 us fit, of 5 us do not.
  expect_lossless(kHd, steps(kHd, 512, 4), 4 * 256);
  expect_lossless(kHd, steps(kHd, 512, 5), 5 * 256);
  expect_lossless(kHd, steps(kHd, 512, 1028), 5 * 256);  // 2^18 / 255
  expect_lossless(kHd, steps(kHd, 512, 1029), 6 * 256);
  expect_lossless(kHd, steps(kHd, 512, 263'172), 6 * 256);  // 2^26 / 255
  expect_lossless(kHd, steps(kHd, 512, 263'173), 16 * 256);
  // 3 bits.
  expect_lossless(kLargest, steps(kLargest, 512, 0), 4 * 256);
  expect_lossless(kLargest, steps(kLargest, 512, 8), 5 * 256);
  expect_lossless(kLargest, steps(kLargest, 512, 9), 6 * 256);
  expect_lossless(kLargest, steps(kLargest, 512, 2056), 6 * 256);
  expect_lossless(kLargest, steps(kLargest, 512, 2057), 16 * 256);
  // One pixel: all but one bit.
  expect_lossless({1, 1}, steps({1, 1}, 512, 4'000'000), 4 * 256);
}

TEST(EventPacker, BackStepsGapsAndTheEndsOfTimeComeBack) {
  std::vector<Event> events = steps(kHd, 700, -3, 1'000'000'000'000'000'000);
  expect_lossless(kHd, events, 0);
  events[300].t = std::numeric_limits<int64_t>::min();
  events[301].t = std::numeric_limits<int64_t>::max();
  expect_lossless(kHd, events, 0);
  std::reverse(events.begin(), events.end());
  expect_lossless(kHd, events, 0);
}

TEST(EventPacker, EventsOutsideComeBackAsTheyAre) {
  std::vector<Event> events = test::make_stream(test::Spread::beyond, kHd, 600, 2);
  events[3].p = 255;
  events[3].x = 65'535;
  expect_lossless(kHd, events, 0);
}

TEST(EventPacker, PartsAndTheirLengthsDoNotMatter) {
  test::Random random(3);
  Packing packing(kHd);
  for (int round = 0; round < 3; ++round) {
    const auto events = test::make_stream(test::Spread::moving_edge, kHd, kMostEvents, 4);
    size_t done = 0;
    while (packing.packer.room() > 0) {
      const size_t end = done + std::min<size_t>(packing.packer.room(), random() % 300);
      std::vector<Event> part(events.begin() + static_cast<std::ptrdiff_t>(done),
                              events.begin() + static_cast<std::ptrdiff_t>(end));
      const size_t cut = part.empty() ? 0 : random() % part.size();
      packing.packer.append(std::span(part).first(cut));
      EXPECT_EQ(packing.unpacked().size(), cut);  // packed again, with what follows
      packing.packer.append(std::span(part).subspan(cut));
      ASSERT_EQ(packing.unpacked(), part);
      packing.packer.end_part();
      done = end;
    }
    packing.packer.restart();
  }
}

TEST(EventPacker, IsFullWhenPartsHaveUsedUpItsBlocks) {
  Packing packing(kHd);
  size_t parts = 0;
  for (; packing.packer.room() > 0; ++parts) {
    packing.packer.append(steps(kHd, 1, 1));
    packing.packer.end_part();
  }
  EXPECT_GT(parts, 64u);
  EXPECT_LT(parts, 100u);
  EXPECT_EQ(packing.memory.size(), EventPacker::memory_words(kMostEvents));
}

class Unpacking : public test::DeviceTest {};

TEST_F(Unpacking, EqualsItsTwin) {
  test::Random random(5);
  PipelineBuilder builder(context_->vulkan());
  EventUnpacker unpacker;
  unpacker.build(builder, kMostEvents);
  vulkan::Buffer packed, copy;
  builder.readback(packed, "packed", EventPacker::memory_words(kMostEvents) * sizeof(uint32_t));
  builder.readback(copy, "copy", kMostEvents * sizeof(Event));
  vulkan::BoundKernel bound;
  unpacker.bind(builder, bound, packed);
  ASSERT_TRUE(builder.result());
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{346, 260}, kHd, kLargest}) {
    for (const int64_t step : {0, 1, 20, 3000, 5'000'000}) {
      SCOPED_TRACE(testing::Message() << sensor.width << " " << step);
      Packing packing(sensor);
      packing.packer.append(steps(sensor, 100 + random() % 300, 1));
      packing.packer.end_part();
      packing.packer.append(steps(sensor, 1 + random() % 1500, step, -70'000));
      const auto part = packing.packer.part();
      std::memcpy(packed.mapped(), packing.memory.data(), packing.memory.size() * sizeof(uint32_t));
      ASSERT_TRUE(run_alone(context_->vulkan(), [&](vulkan::Commands& c) {
        unpacker.record(c, bound, part.push);
        c.copy(unpacker.events(), 0, copy, 0, part.push.events * sizeof(Event));
      }));
      const auto twin = packing.unpacked();
      for (size_t i = 0; i < twin.size(); ++i) ASSERT_EQ(copy.mapped_as<Event>()[i], twin[i]) << i;
    }
  }
}

class PackedStream : public test::DeviceTest, public testing::WithParamInterface<DeviceOptions::Upload> {
 protected:
  void SetUp() override { open(test::checked_options(GetParam())); }
};

TEST_P(PackedStream, CarriesEveryEvent) {
  test::Random random(6);
  for (const SensorSize sensor : {SensorSize{346, 260}, kLargest}) {
    GpuOptions options;
    options.submission_events = 700;
    auto made = std::make_unique<test::EventRecorder>(*context_, sensor, 700, 50'000);
    test::EventRecorder& recorder = *made;
    const auto stream = test::value_of(Stream::create(context_, std::move(made), options));
    std::vector<Event> expected;
    int64_t t = 1'000'000;
    for (int i = 0; i < 120; ++i) {
      auto events = test::make_stream(test::kSpreads[random() % 8], sensor, random() % 500, random(), t);
      t += static_cast<int64_t>(random() % (random() % 9 == 0 ? 9'000'000 : 50'000));
      if (random() % 3 == 0) {
        const auto lent = test::value_of(stream->acquire(events.size()));
        std::copy(events.begin(), events.end(), lent.begin());
        events.resize(events.size() / 2);
        ASSERT_TRUE(stream->commit(events.size()));
      } else {
        ASSERT_TRUE(stream->push(events));
      }
      if (random() % 4 == 0) {
        ASSERT_TRUE(stream->flush());
      }
      std::copy_if(events.begin(), events.end(), std::back_inserter(expected),
                   [&](const Event& e) { return sensor.contains(e); });
    }
    ASSERT_EQ(test::value_of(recorder.recorded(*stream)).events, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, PackedStream,
                         testing::Values(DeviceOptions::Upload::automatic, DeviceOptions::Upload::staged,
                                         DeviceOptions::Upload::transfer_queue));

}  // namespace
}  // namespace scarf
