// Every frame of a replay against the reference that was pushed event by event up to the frame's place.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

#include "scarf/device/replay.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using Instants = std::vector<uint64_t>;  // events, outside ones included, before each frame; ascending

template <class T>
struct Taken {
  std::vector<Image<T>> images;
  std::vector<uint64_t> events;
};

template <class T>
TakeReplayFrame<T> into(Taken<T>& taken) {
  return [&taken](const ReplayFrame<T>& frame) -> Result<void> {
    EXPECT_EQ(frame.index, taken.images.size());
    Image<T> image(frame.sensor.width, frame.sensor.height);
    EXPECT_EQ(frame.pixels.size(), image.pixels.size());
    std::copy(frame.pixels.begin(), frame.pixels.end(), image.pixels.begin());
    taken.images.push_back(std::move(image));
    taken.events.push_back(frame.events);
    return {};
  };
}

template <class T>
Image<T> picture_of(Scarf& scarf);
template <>
Image<uint8_t> picture_of(Scarf& scarf) {
  return test::value_of(scarf.u8_image());
}
template <>
Image<float> picture_of(Scarf& scarf) {
  return test::value_of(scarf.float_image());
}
template <>
Image<int32_t> picture_of(Scarf& scarf) {
  return test::value_of(scarf.count_image());
}

class ReplayEquivalence : public test::DeviceTest {
 protected:
  // Pushes in pieces of at most `batch` events.
  static void play(Replay& replay, std::span<const Event> events, const Instants& instants, size_t batch) {
    size_t pushed = 0;
    const auto push_to = [&](size_t end) {
      while (pushed < end) {
        const size_t n = std::min(batch, end - pushed);
        const auto report = replay.push(events.subspan(pushed, n));
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_EQ(report->accepted, n);
        pushed += n;
      }
    };
    for (const uint64_t instant : instants) {
      ASSERT_NO_FATAL_FAILURE(push_to(instant));
      ASSERT_TRUE(replay.frame());
    }
    ASSERT_NO_FATAL_FAILURE(push_to(events.size()));
    ASSERT_TRUE(replay.finish());
  }

  template <class T>
  void expect_same_frames(const Geometry& geometry, std::span<const Event> events, const Instants& instants,
                          const ReplayOptions& options, size_t batch = 1000) {
    Taken<T> taken;
    auto replay =
        test::value_of(make_gpu_replay<T>(context_, geometry, into(taken), kDefaultAccumulation, options));
    ASSERT_NE(replay, nullptr);
    ASSERT_NO_FATAL_FAILURE(play(*replay, events, instants, batch));
    ASSERT_EQ(taken.images.size(), instants.size());
    auto reference = reference_scarf(geometry);
    uint64_t pushed = 0;
    uint64_t inside = 0;
    for (size_t i = 0; i < instants.size(); ++i) {
      for (; pushed < instants[i]; ++pushed) {
        ASSERT_TRUE(reference->push(events.subspan(pushed, 1)));
        if (geometry.sensor().contains(events[pushed])) ++inside;
      }
      ASSERT_EQ(taken.events[i], inside);
      ASSERT_EQ(taken.images[i], picture_of<T>(*reference)) << "frame " << i << " at " << instants[i];
    }
  }
};

Instants random_instants(size_t events, size_t count, std::mt19937& random) {
  Instants instants(count);
  for (uint64_t& i : instants) i = random() % (events + 1);
  std::sort(instants.begin(), instants.end());
  return instants;
}

Instants every(size_t step, size_t events) {
  Instants instants;
  for (size_t i = 0; i <= events; i += step) instants.push_back(i);
  return instants;
}

TEST_F(ReplayEquivalence, EveryPresetAndSpread) {
  const SensorSize sensor = {61, 47};
  std::mt19937 random(1);
  for (const Preset preset :
       {Preset::paper, Preset::light, Preset::event_driven, Preset::event_driven_flex}) {
    const Geometry geometry = *make_geometry(preset, sensor);
    for (const test::Spread spread : test::kSpreads) {
      SCOPED_TRACE(std::string(preset_name(preset)) + " spread " + std::to_string(static_cast<int>(spread)));
      const auto events = test::make_stream(spread, sensor, 4000, random());
      ASSERT_NO_FATAL_FAILURE(
          expect_same_frames<uint8_t>(geometry, events, random_instants(events.size(), 25, random), {}));
    }
  }
}

TEST_F(ReplayEquivalence, RandomGeometriesGroupsAndChunks) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const SensorSize sensor = {static_cast<int32_t>(20 + random() % 60),
                               static_cast<int32_t>(20 + random() % 60)};
    const Geometry geometry = test::random_geometry(sensor, random);
    ReplayOptions options;
    options.group_frames = static_cast<uint32_t>(random() % 12);
    options.group_events = static_cast<uint32_t>(random() % 3 == 0 ? 0 : 1 + random() % 900);
    options.chunk_events = static_cast<uint32_t>(random() % 60);
    SCOPED_TRACE(to_string(geometry));
    const auto events = test::make_stream(test::kSpreads[trial % std::size(test::kSpreads)], sensor, 2500,
                                          random(), -1'000'000);
    const Instants instants = random_instants(events.size(), 30, random);
    const size_t batch = 1 + random() % 700;
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(geometry, events, instants, options, batch));
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<float>(geometry, events, instants, options, batch));
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<int32_t>(geometry, events, instants, options, batch));
  }
}

TEST_F(ReplayEquivalence, AFrameAfterEveryEvent) {
  const SensorSize sensor = {30, 25};
  const auto events = test::make_stream(test::Spread::moving_edge, sensor, 1500, 4);
  const Geometry geometry = *make_geometry(Preset::paper, sensor, {.cell = 4});
  for (const uint32_t group_frames : {0u, 1u, 7u, 1500u}) {
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(geometry, events, every(1, events.size()),
                                                        {.group_frames = group_frames}));
  }
}

TEST_F(ReplayEquivalence, RepeatedInstantsAndThoseAtBothEnds) {
  const SensorSize sensor = {40, 30};
  const auto events = test::make_stream(test::Spread::uniform, sensor, 900, 5);
  const Geometry geometry = *make_geometry(Preset::light, sensor);
  Instants instants(40, 0);                   // before the first event
  instants.insert(instants.end(), 300, 300);  // more than a group, at its end
  instants.insert(instants.end(), 30, 450);   // within a group
  instants.insert(instants.end(), 40, 900);   // at the end
  for (const uint32_t group_events : {0u, 1u, 300u}) {
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(geometry, events, instants,
                                                        {.group_frames = 100, .group_events = group_events}));
  }
}

TEST_F(ReplayEquivalence, ThousandsOfFramesInOneGroup) {
  const SensorSize sensor = {33, 21};  // 693 pixels: no multiple of four
  const auto events = test::make_stream(test::Spread::moving_edge, sensor, 9000, 6);
  const Geometry geometry = *make_geometry(Preset::paper, sensor);
  ASSERT_NO_FATAL_FAILURE(
      expect_same_frames<uint8_t>(geometry, events, every(3, events.size()), {.group_frames = 4096}));
}

// The oldest events outlive many groups, of which some bring nothing.
TEST_F(ReplayEquivalence, EventsAreCarriedAcrossGroups) {
  const SensorSize sensor = {50, 40};
  std::mt19937 random(7);
  for (const int32_t capacity : {1, 2, 31, 32, 33, 255, 256, 700}) {
    SCOPED_TRACE(capacity);
    Geometry geometry = *make_geometry(Preset::paper, sensor);
    geometry.capacity = capacity;
    const auto events = test::make_stream(test::Spread::border, sensor, 3000, random());
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<int32_t>(geometry, events, every(60, events.size()),
                                                        {.group_frames = 3, .group_events = 50}));
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(geometry, events, every(60, events.size()),
                                                        {.group_frames = 9, .group_events = 170}));
  }
}

// Counts beyond 8 bits, and a pixel that takes a whole ring.
TEST_F(ReplayEquivalence, HotPixelFillsItsRing) {
  const SensorSize sensor = {24, 24};
  for (const int32_t capacity : {255, 256, 1000, kMaxCapacity}) {
    SCOPED_TRACE(capacity);
    Geometry geometry = *make_geometry(Preset::light, sensor);
    geometry.capacity = capacity;
    std::vector<Event> events(3000, Event{.t = 0, .x = 13, .y = 12, .p = 1});
    // Neighbours in the same word must not feel its carries and borrows.
    for (size_t i = 0; i < events.size(); i += 7) events[i].x = static_cast<uint16_t>(12 + i / 7 % 4);
    for (size_t i = 2000; i < events.size(); ++i) events[i].y = 14;
    ASSERT_NO_FATAL_FAILURE(
        expect_same_frames<int32_t>(geometry, events, every(100, events.size()), {.group_events = 650}));
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(geometry, events, every(100, events.size()), {}));
  }
}

TEST_F(ReplayEquivalence, EveryUploadPath) {
  const SensorSize sensor = {40, 30};
  const auto events = test::make_stream(test::Spread::uniform, sensor, 2000, 8);
  for (const auto upload : {DeviceOptions::Upload::staged, DeviceOptions::Upload::transfer_queue}) {
    open(test::checked_options(upload));
    ASSERT_NO_FATAL_FAILURE(expect_same_frames<uint8_t>(*make_geometry(Preset::paper, sensor), events,
                                                        every(37, events.size()), {.group_frames = 10}));
    ASSERT_NO_FATAL_FAILURE(TearDown());
  }
}

TEST_F(ReplayEquivalence, GoesOnAfterFinish) {
  const SensorSize sensor = {40, 30};
  const Geometry geometry = *make_geometry(Preset::paper, sensor);
  const auto events = test::make_stream(test::Spread::uniform, sensor, 1000, 9);
  Taken<uint8_t> taken;
  auto replay = test::value_of(make_gpu_replay<uint8_t>(context_, geometry, into(taken)));
  auto reference = reference_scarf(geometry);
  ASSERT_TRUE(replay->finish());  // nothing at all
  for (size_t i = 0; i < 5; ++i) {
    const auto some = std::span(events).subspan(200 * i, 200);
    ASSERT_TRUE(replay->push(some));
    ASSERT_TRUE(replay->frame());
    ASSERT_TRUE(replay->finish());
    ASSERT_TRUE(replay->push({}));
    ASSERT_TRUE(reference->push(some));
    ASSERT_EQ(taken.images.size(), i + 1);
    ASSERT_EQ(taken.images.back(), test::value_of(reference->u8_image()));
  }
  EXPECT_EQ(taken.events.back(), 1000u);
}

TEST_F(ReplayEquivalence, RefusesBatchesAsTheReferenceDoes) {
  const Geometry geometry = *make_geometry(Preset::paper, {40, 30});
  Taken<uint8_t> taken;
  auto replay = test::value_of(make_gpu_replay<uint8_t>(context_, geometry, into(taken)));
  auto reference = reference_scarf(geometry);
  std::vector<Event> events = {{.t = 5, .x = 1, .y = 1, .p = 1}, {.t = 6, .x = 2, .y = 1, .p = 2}};
  const auto refused = replay->push(events);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, reference->push(events).error().message);
  events[1] = {.t = 6, .x = 40, .y = 1, .p = 2};  // outside: p does not matter
  const auto report = replay->push(events);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outside, 1u);
  ASSERT_TRUE(reference->push(events));
  ASSERT_TRUE(replay->frame());
  ASSERT_TRUE(replay->finish());
  EXPECT_EQ(taken.images.at(0), test::value_of(reference->u8_image()));
}

TEST_F(ReplayEquivalence, AnErrorOfTheTakerEndsTheReplay) {
  const TakeReplayFrame<uint8_t> full = [](const ReplayFrame<uint8_t>&) -> Result<void> {
    return Error{ErrorCode::io, "the disk is full"};
  };
  auto replay =
      test::value_of(make_gpu_replay<uint8_t>(context_, *make_geometry(Preset::paper, {40, 30}), full));
  ASSERT_TRUE(replay->frame());
  EXPECT_EQ(replay->finish().error().message, "the disk is full");
  EXPECT_EQ(replay->frame().error().message, "the disk is full");
  EXPECT_EQ(replay->push({}).error().message, "the disk is full");
  EXPECT_EQ(replay->finish().error().code, ErrorCode::io);
}

TEST_F(ReplayEquivalence, RefusesParametersByName) {
  const Geometry geometry = *make_geometry(Preset::paper, {40, 30});
  Taken<float> taken;
  const auto message = [&](const Geometry& g, double accumulation, const ReplayOptions& options) {
    const auto made = make_gpu_replay<float>(context_, g, into(taken), accumulation, options);
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(message(geometry, -1, {}), "accumulation is -1, legal is a finite number > 0");
  EXPECT_EQ(message(geometry, 1, {.group_frames = 1u << 20}), "group_frames is 1048576, legal is 0 to 4096");
  Geometry wrong = geometry;
  wrong.capacity = 0;
  EXPECT_NE(message(wrong, 1, {}).find("capacity"), std::string::npos);
}

// Counts the dispatches of a device.
struct Dispatches {
  static inline uint64_t count = 0;
  static inline PFN_vkCmdDispatch real = nullptr;
  static VKAPI_ATTR void VKAPI_CALL call(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
    ++count;
    real(commands, x, y, z);
  }
  static void install(vulkan::Table& table) {
    if (table.CmdDispatch == nullptr || table.CmdDispatch == call) return;
    real = table.CmdDispatch;
    table.CmdDispatch = call;
  }
};

TEST(ReplayDispatches, DoNotGrowWithTheFramesOfAGroup) {
  const auto context = test::value_of(test::create_context({}, Dispatches::install));
  const SensorSize sensor = {40, 30};
  const auto events = test::make_stream(test::Spread::uniform, sensor, 3000, 10);
  std::vector<uint64_t> dispatches;
  for (const size_t step : {3000, 30, 1}) {  // 2, 101, 3001 frames
    Taken<uint8_t> taken;
    auto replay =
        test::value_of(make_gpu_replay<uint8_t>(context, *make_geometry(Preset::paper, sensor), into(taken),
                                                kDefaultAccumulation, {.group_frames = 4096}));
    Dispatches::count = 0;
    for (size_t i = 0; i <= events.size(); ++i) {
      if (i % step == 0) {
        ASSERT_TRUE(replay->frame());
      }
      if (i < events.size()) {
        ASSERT_TRUE(replay->push(std::span(events).subspan(i, 1)));
      }
    }
    ASSERT_TRUE(replay->finish());
    ASSERT_EQ(taken.images.size(), 3000 / step + 1);
    dispatches.push_back(Dispatches::count);
  }
  EXPECT_EQ(dispatches, std::vector<uint64_t>(3, 8));
}

}  // namespace
}  // namespace scarf
