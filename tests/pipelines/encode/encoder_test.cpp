// Encodings on the device against the reference, scarf::encode.
#include "pipelines/encode/encoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <random>

#include "pipelines/scarf/pipeline.h"
#include "scarf/device/encoder.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;
using Convention = VoxelGridParameters::Convention;

const EncodingParameters kEncodings[] = {
    VoxelGridParameters{},
    VoxelGridParameters{1, Convention::e2vid},
    VoxelGridParameters{7, Convention::eventgan},
    ToreParameters{},
    ToreParameters{1},
    ToreParameters{20},
    EventImageParameters{},
    TimeSurfaceParameters{},
    TimeSurfaceParameters{77},
};

class Encoders : public test::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    commands_ = test::value_of(Commands::create(context_->vulkan(), context_->vulkan().compute()));
  }

  Buffer buffer_of(const void* content, size_t bytes, size_t room) {
    Buffer buffer = test::value_of(
        Buffer::create(context_->vulkan(), "test", std::max<size_t>(room, 16), MemoryUse::upload));
    if (bytes > 0) std::memcpy(buffer.mapped(), content, bytes);
    return buffer;
  }

  std::vector<uint32_t> bits_of(const Encoder& encoder, const Encoder::Bound& bound) {
    const EncodingShape shape = encoder.shape();
    const size_t values = static_cast<size_t>(shape.planes) * shape.height * shape.width;
    const Buffer host = test::value_of(
        Buffer::create(context_->vulkan(), "test", values * sizeof(float), MemoryUse::readback));
    EXPECT_TRUE(commands_.begin());
    encoder.record(commands_, bound);
    commands_.copy(encoder.tensor(), 0, host, 0, values * sizeof(float));
    EXPECT_TRUE(commands_.submit() && commands_.wait());
    return {host.mapped_as<uint32_t>(), host.mapped_as<uint32_t>() + values};
  }

  static void compare(const std::vector<uint32_t>& bits, const EncodingParameters& parameters,
                      SensorSize sensor, std::span<const Event> events) {
    const Image<float> expected = test::value_of(encode(parameters, sensor, events));
    ASSERT_EQ(bits.size(), expected.pixels.size());
    for (size_t i = 0; i < bits.size(); ++i) {
      ASSERT_EQ(bits[i], std::bit_cast<uint32_t>(expected.pixels[i]))
          << info_of(parameters).name << ", value " << i << ": " << std::bit_cast<float>(bits[i]) << " and "
          << expected.pixels[i];
    }
  }

  // Two buffers with room for more events than there are.
  void compare(const EncodingParameters& parameters, SensorSize sensor, const std::vector<Event>& events,
               uint64_t most_per_pixel = 0) {
    const size_t half = events.size() / 3 + 1;
    const size_t in_first = std::min(events.size(), half);
    const size_t rest = events.size() - in_first;
    const auto total = static_cast<uint32_t>(events.size());
    const Buffer first = buffer_of(events.data(), in_first * sizeof(Event), half * sizeof(Event));
    const Buffer second =
        buffer_of(events.data() + in_first, rest * sizeof(Event), (rest + 9) * sizeof(Event));
    const Buffer count = buffer_of(&total, sizeof(total), sizeof(total));
    const DeviceEvents input = {&first, &second, &count, half, half + rest + 9, most_per_pixel};
    const auto encoder = Encoder::create(context_->vulkan(), parameters, sensor, input.most_events);
    ASSERT_TRUE(encoder) << encoder.error().message;
    const auto bound = test::value_of((*encoder)->bind(input));
    ASSERT_TRUE(bound);
    for (int again = 0; again < 2; ++again) {
      ASSERT_NO_FATAL_FAILURE(compare(bits_of(**encoder, *bound), parameters, sensor, events));
    }
  }

  Commands commands_;
};

TEST_F(Encoders, EveryEncodingAndSpread) {
  std::mt19937 random(1);
  for (const EncodingParameters& parameters : kEncodings) {
    for (Spread spread : test::kSpreads) {
      const SensorSize sensor = {31, 22};
      const auto begin = static_cast<int64_t>(random()) - 2'000'000'000;
      ASSERT_NO_FATAL_FAILURE(
          compare(parameters, sensor, make_stream(spread, sensor, 3000, random(), begin)));
    }
  }
}

TEST_F(Encoders, FewEventsAndTinySensors) {
  std::mt19937 random(2);
  for (const EncodingParameters& parameters : kEncodings) {
    for (size_t count : {0, 1, 2, 5}) {
      for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{3, 2}}) {
        ASSERT_NO_FATAL_FAILURE(
            compare(parameters, sensor, make_stream(Spread::uniform, sensor, count, random())));
        ASSERT_NO_FATAL_FAILURE(
            compare(parameters, sensor, make_stream(Spread::beyond, sensor, count, random())));
      }
    }
  }
}

// Events in any order, long spans (whose unit of time is more than a microsecond), times that differ in their
// high or their low words only, and equal times.
TEST_F(Encoders, TimesOfAllKinds) {
  std::mt19937_64 random(3);
  const SensorSize sensor = {6, 5};
  for (const EncodingParameters& parameters : kEncodings) {
    for (int bits : {0, 1, 8, 20, 31, 32, 33, 39, 40, 41, 48, 63, 64}) {
      auto events = make_stream(Spread::beyond, sensor, 700, random());
      for (Event& e : events) {
        e.t = bits == 0 ? 5
                        : static_cast<int64_t>(random() >> (64 - bits) << (random() % 3 == 0 ? bits / 2 : 0));
      }
      ASSERT_NO_FATAL_FAILURE(compare(parameters, sensor, events)) << bits;
    }
  }
}

TEST_F(Encoders, TheLongestSpanOfTimes) {
  for (const EncodingParameters& parameters : kEncodings) {
    const std::vector<Event> events = {{INT64_MIN, 0, 0, 1, {}}, {0, 1, 0, 0, {}}, {INT64_MAX, 1, 1, 1, {}}};
    ASSERT_NO_FATAL_FAILURE(compare(parameters, {2, 2}, events));
  }
}

// More events of one pixel than a driver's loops count, and sums that a float does not hold exactly.
TEST_F(Encoders, HotPixel) {
  const SensorSize sensor = {9, 9};
  auto events = make_stream(Spread::one_pixel, sensor, 70'000, 4);
  for (Event& e : events) e.p = 1;
  for (const EncodingParameters& parameters :
       {EncodingParameters(VoxelGridParameters{2}), EncodingParameters(ToreParameters{3}),
        EncodingParameters(EventImageParameters{})}) {
    ASSERT_NO_FATAL_FAILURE(compare(parameters, sensor, events));
  }
}

TEST_F(Encoders, KnownNumberOfEventsPerPixel) {
  const SensorSize sensor = {40, 30};
  ASSERT_NO_FATAL_FAILURE(
      compare(ToreParameters{3}, sensor, make_stream(Spread::uniform, sensor, 1200, 5), 400));
}

// The active events of SCARF, as its extract stages leave them.
TEST_F(Encoders, EventsOfScarf) {
  const SensorSize sensor = {64, 48};
  const Geometry geometry = *make_geometry(Preset::light, sensor);
  vulkan::Device& device = context_->vulkan();
  const Plan plan =
      test::value_of(make_plan(geometry, make_levels(0.3, geometry.capacity)->u8, device.limits(), {}));
  const auto scarf =
      test::value_of(ScarfPipeline::create(device, geometry, *make_levels(0.3, geometry.capacity), plan));
  const auto events = make_stream(Spread::moving_edge, sensor, 6000, 6);
  const Buffer staging =
      buffer_of(events.data(), events.size() * sizeof(Event), events.size() * sizeof(Event));
  const auto binding = test::value_of(scarf->bind_events(staging));
  const auto target = test::value_of(scarf->make_extract_memory());
  const int64_t t_first = events.front().t;
  ASSERT_TRUE(commands_.begin());
  scarf->record_reset(commands_);
  commands_.barrier();
  scarf->record_push(commands_, *binding, 0, static_cast<uint32_t>(events.size()), {t_first, {}, {}});
  scarf->record_extract(commands_, *target, 0, plan.patches, /*active_only=*/true, t_first);
  ASSERT_TRUE(commands_.submit() && commands_.wait());

  const auto reference = reference_scarf(geometry);
  ASSERT_TRUE(reference->push(events));
  const auto active = test::value_of(reference->active_events(EventOrder::by_patch));
  const uint64_t half = scarf->half_events();
  const DeviceEvents input = {&target->first, &target->second, &target->total,
                              half,           2 * half,        static_cast<uint64_t>(geometry.capacity)};
  for (const EncodingParameters& parameters : kEncodings) {
    const auto encoder = test::value_of(Encoder::create(device, parameters, sensor, input.most_events));
    const auto bound = test::value_of(encoder->bind(input));
    ASSERT_NO_FATAL_FAILURE(compare(bits_of(*encoder, *bound), parameters, sensor, active));
  }
}

// Through the public interface, between pushes, and dropped while it is in flight.
TEST_F(Encoders, OfAScarfThatGoesOn) {
  const SensorSize sensor = {70, 45};
  const auto scarf = device_scarf(*make_geometry(Preset::light, sensor));
  for (const EncodingParameters& parameters : kEncodings) {
    const auto encoder = make_gpu_encoder(*scarf, parameters);
    ASSERT_TRUE(encoder) << encoder.error().message;
    for (uint32_t seed : {1, 2}) {
      ASSERT_TRUE(scarf->push(make_stream(Spread::moving_edge, sensor, 5000, seed, 1000)));
      const auto events = test::value_of(scarf->active_events());
      const Image<float> expected = test::value_of(encode(parameters, sensor, events));
      ASSERT_EQ(test::value_of((*encoder)->encode()), expected) << info_of(parameters).name;
    }
    (void)(*encoder)->encode();
  }
  EXPECT_FALSE(make_gpu_encoder(*scarf, HatsParameters{}));
}

TEST_F(Encoders, RefusesWhatIsNotThere) {
  for (const EncodingParameters& parameters :
       {EncodingParameters(HatsParameters{}), EncodingParameters(HotsParameters{}),
        EncodingParameters(TimeSurfaceParameters{1'000'000'000}), EncodingParameters(ToreParameters{0})}) {
    const auto encoder = Encoder::create(context_->vulkan(), parameters, {8, 8}, 100);
    ASSERT_FALSE(encoder);
    EXPECT_EQ(encoder.error().code, ErrorCode::illegal_parameter);
  }
}

}  // namespace
}  // namespace scarf
