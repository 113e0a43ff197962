// sits on a device: both strategies, forced, against the reference.
#include "pipelines/sits/sits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "device/on_device.h"
#include "shaders/sits/sits_layout.h"
#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;
using Rule = SitsParameters::Rule;

constexpr Rule kRules[] = {Rule::paper, Rule::greater, Rule::event_driven};

// As the public interface, over a pipeline with choices of its own.
class DeviceSits final : public OnDevice<GpuRepresentation> {
 public:
  DeviceSits(std::shared_ptr<Stream> stream, ImagePipeline& pipeline)
      : OnDevice(Feed{std::move(stream)}), pipeline_(pipeline) {}

  SensorSize sensor() const override { return pipeline_.sensor(); }
  U8Picture u8_picture() const override {
    return {[&pipeline = pipeline_](Query& q, const StreamFacts& times, std::optional<int64_t> now) {
      return pipeline.record_u8(q.commands, times, now);
    }};
  }
  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) override {
    return stream_->query<Image<uint8_t>>(QueryKind::image, [&](Query& q, const StreamFacts& times) {
      return u8_picture().record(q, times, now);
    });
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) override {
    return stream_->query<Image<float>>(QueryKind::image, [&](Query& q, const StreamFacts& times) {
      return pipeline_.record_float(q.commands, times, now);
    });
  }
  Pending<Image<int64_t>> raw_image() override {
    return stream_->query<Image<int64_t>>(QueryKind::state, [&](Query& q, const StreamFacts& times) {
      return pipeline_.record_raw(q.commands, times);
    });
  }
  Pending<std::vector<Event>> events() override {
    return stream_->query<std::vector<Event>>(QueryKind::events, [&](Query& q, const StreamFacts& times) {
      return pipeline_.record_events(q.commands, times);
    });
  }
  Pending<std::vector<uint8_t>> state() override {
    return stream_->query<std::vector<uint8_t>>(QueryKind::state, [&](Query& q, const StreamFacts& times) {
      return pipeline_.record_state(q.commands, times);
    });
  }

 private:
  ImagePipeline& pipeline_;
};

class Sits : public test::DeviceTest {
 protected:
  std::unique_ptr<GpuRepresentation> device(const SitsParameters& parameters, SensorSize sensor,
                                            const SitsChoices& choices, const GpuOptions& options = {}) {
    auto pipeline = make_sits(context_->vulkan(), parameters, sensor, options, choices);
    if (!pipeline) {
      ADD_FAILURE() << pipeline.error().message;
      return nullptr;
    }
    ImagePipeline& images = **pipeline;
    auto stream = test::value_of(Stream::create(context_, std::move(*pipeline), options));
    return std::make_unique<DeviceSits>(std::move(stream), images);
  }

  // Pushes the stream in batches of random sizes (with empty ones among them), compared after each.
  void compare(const SitsParameters& parameters, SensorSize sensor, const std::vector<Event>& events,
               const SitsChoices& choices, std::mt19937& random, const GpuOptions& options = {}) {
    const auto d = device(parameters, sensor, choices, options);
    const auto r = test::reference(parameters, sensor);
    ASSERT_TRUE(d && r);
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*d, *r));
    for (size_t done = 0; done < events.size();) {
      const size_t n = random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % events.size());
      const auto batch = std::span(events).subspan(done, n);
      ASSERT_TRUE(d->push(batch) && r->push(batch));
      done += n;
      ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*d, *r));
    }
    ASSERT_TRUE(d->reset() && r->reset());
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*d, *r));
  }
};

// Both strategies, and sweeps that are too few, so that the walk has to finish.
const SitsChoices kEveryWay[] = {{SitsStrategy::walk, {}, {}},
                                 {SitsStrategy::sweeps, {}, {}},
                                 {SitsStrategy::sweeps, 3, 16},
                                 {SitsStrategy::sweeps, 1, 64}};

TEST_F(Sits, EveryRuleSpreadAndWay) {
  std::mt19937 random(1);
  for (const SitsChoices& choices : kEveryWay) {
    for (Rule rule : kRules) {
      for (Spread spread : test::kSpreads) {
        SCOPED_TRACE(testing::Message() << "way " << &choices - kEveryWay << " rule "
                                        << static_cast<int>(rule) << " spread " << static_cast<int>(spread));
        const SensorSize sensor = {1 + static_cast<int32_t>(random() % 140),
                                   1 + static_cast<int32_t>(random() % 90)};
        GpuOptions options;
        options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 700);
        ASSERT_NO_FATAL_FAILURE(compare({rule, 9}, sensor, make_stream(spread, sensor, 1500, random()),
                                        choices, random, options));
      }
    }
  }
}

TEST_F(Sits, EveryKernel) {
  std::mt19937 random(2);
  for (const SitsChoices& choices : kEveryWay) {
    for (int32_t kernel : {3, 5, 7, 11, 13, 17, 31, 33, 63}) {
      SCOPED_TRACE(testing::Message() << "way " << &choices - kEveryWay << " kernel " << kernel);
      const Rule rule = kRules[random() % 3];
      const SensorSize sensor = {100, 70};
      ASSERT_NO_FATAL_FAILURE(compare(
          {rule, kernel}, sensor, make_stream(Spread::moving_edge, sensor, 800, random()), choices, random));
    }
  }
}

// Smaller than the window, the team or a tile.
TEST_F(Sits, TinySensors) {
  std::mt19937 random(3);
  for (const SitsChoices& choices : kEveryWay) {
    for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{2, 3}, SensorSize{1, 50}, SensorSize{50, 1},
                                    SensorSize{5, 5}, SensorSize{33, 17}}) {
      for (int32_t kernel : {3, 9, 63}) {
        const Rule rule = kRules[random() % 3];
        ASSERT_NO_FATAL_FAILURE(compare({rule, kernel}, sensor,
                                        make_stream(Spread::beyond, sensor, 300, random()), choices, random));
      }
    }
  }
}

TEST_F(Sits, HighDefinition) {
  std::mt19937 random(4);
  const SensorSize sensor = {1280, 720};
  for (const SitsStrategy strategy : {SitsStrategy::walk, SitsStrategy::sweeps}) {
    ASSERT_NO_FATAL_FAILURE(compare({Rule::paper, 9}, sensor,
                                    make_stream(Spread::moving_edge, sensor, 20'000, 3), {strategy, {}, {}},
                                    random));
  }
}

// Each event looks at what the one before left behind, back and forth over all tiles: every sweep settles
// about one tile more, so the fewer are allowed, the sooner the walk has to finish.
TEST_F(Sits, ChainsOverManyTiles) {
  std::mt19937 random(5);
  const SensorSize sensor = {200, 5};
  std::vector<Event> events;
  for (int pass = 0; pass < 4; ++pass) {
    for (int32_t i = 0; i < sensor.width; ++i) {
      const int32_t x = pass % 2 == 0 ? i : sensor.width - 1 - i;
      for (int32_t y : {2, 2 + pass % 3}) events.push_back(test::event(0, x, y));
    }
  }
  for (Rule rule : kRules) {
    for (uint32_t sweeps : {1u, 2u, 3u, 5u, 8u, 13u, 24u, 50u}) {
      for (uint32_t tile : {16u, 32u}) {
        SCOPED_TRACE(testing::Message() << "rule " << static_cast<int>(rule) << " sweeps " << sweeps);
        ASSERT_NO_FATAL_FAILURE(
            compare({rule, 9}, sensor, events, {SitsStrategy::sweeps, sweeps, tile}, random));
      }
    }
  }
}

// Tiles settle, are skipped, and start again when their neighbours find something new.
TEST_F(Sits, BurstsThatCrossTilesAgain) {
  std::mt19937 random(6);
  const SensorSize sensor = {96, 96};
  for (Rule rule : kRules) {
    std::vector<Event> events;
    for (int burst = 0; burst < 40; ++burst) {
      const auto x = static_cast<int32_t>(random() % 96);
      const auto y = static_cast<int32_t>(random() % 96);
      for (int i = 0; i < 50; ++i) {
        events.push_back(
            test::event(0, std::clamp<int32_t>(x + static_cast<int32_t>(random() % 13) - 6, 0, 95),
                        std::clamp<int32_t>(y + static_cast<int32_t>(random() % 13) - 6, 0, 95)));
      }
    }
    for (uint32_t sweeps : {4u, 24u, 100u}) {
      ASSERT_NO_FATAL_FAILURE(compare({rule, 9}, sensor, events, {SitsStrategy::sweeps, sweeps, 16}, random));
    }
  }
}

// Points that walk to and fro, so that what tiles find goes different ways at a time: a tile that rests while
// what it found last still travels must not fall back behind it.
TEST_F(Sits, WalkersThatMeet) {
  std::mt19937 random(8);
  const SensorSize sensor = {150, 20};
  const auto d = device({Rule::paper, 5}, sensor, {SitsStrategy::sweeps, 200, 16});
  const auto r = test::reference(SitsParameters{Rule::paper, 5}, sensor);
  ASSERT_TRUE(d && r);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Event> events;
    const size_t walkers = 2 + random() % 4;
    std::vector<int32_t> x(walkers), y(walkers), step(walkers);
    for (size_t w = 0; w < walkers; ++w) {
      x[w] = static_cast<int32_t>(random() % 150);
      y[w] = static_cast<int32_t>(random() % 20);
      step[w] = random() % 2 == 0 ? -1 : 1;
    }
    for (int i = 0; i < 400; ++i) {
      const size_t w = random() % walkers;
      x[w] = std::clamp(x[w] + step[w], 0, sensor.width - 1);
      if (random() % 50 == 0 || x[w] == 0 || x[w] == sensor.width - 1) step[w] = -step[w];
      events.push_back(
          test::event(0, x[w], std::clamp(y[w] + static_cast<int32_t>(random() % 3) - 1, 0, 19)));
    }
    ASSERT_TRUE(d->push(events) && r->push(events));
    ASSERT_EQ(test::value_of(d->state()), test::value_of(r->state())) << "trial " << trial;
  }
}

TEST_F(Sits, HotPixel) {
  std::mt19937 random(7);
  const SensorSize sensor = {64, 48};
  const auto events = make_stream(Spread::one_pixel, sensor, 100'000, 5);
  for (const SitsStrategy strategy : {SitsStrategy::walk, SitsStrategy::sweeps}) {
    for (Rule rule : kRules) {
      ASSERT_NO_FATAL_FAILURE(compare({rule, 9}, sensor, events, {strategy, {}, {}}, random));
    }
  }
}

TEST(SitsPlan, StaysWithinTheLoopBudget) {
  for (uint32_t lanes : {4u, 8u, 16u, 32u, 64u, 128u}) {
    for (int32_t kernel = 3; kernel <= 63; kernel += 2) {
      vulkan::Limits limits;
      limits.subgroup_size = lanes;
      limits.loop_trips = 60'000;
      limits.cpu = true;
      const SitsPlan walk = make_sits_plan(kernel, limits, {}, {SitsStrategy::walk, {}, {}});
      EXPECT_EQ(walk.strategy, SitsStrategy::walk);
      EXPECT_EQ(walk.team_lanes(), lanes);
      ASSERT_GT(walk.walk_events, 0u);
      const uint64_t walk_blocks = (walk.walk_events + lanes - 1) / lanes;
      EXPECT_LE(walk_blocks * sits_trips_per_block(walk, static_cast<uint32_t>(kernel)), limits.loop_trips);
      for (uint32_t tile : {16u, 32u, 64u}) {
        const SitsPlan sweeps = make_sits_plan(kernel, limits, {}, {SitsStrategy::sweeps, {}, tile});
        EXPECT_EQ(tile % (2 * sweeps.team_x) + tile % sweeps.team_y, 0u);
        ASSERT_GT(sweeps.submission_events, 0u);
        const uint64_t blocks = (sweeps.submission_events + lanes - 1) / lanes;
        const uint64_t pairs = tile * tile / 2 / lanes;
        const uint64_t replay = blocks * sits_trips_per_block(sweeps, std::min<uint32_t>(tile, kernel));
        EXPECT_LE(replay + 2 * (pairs + 1) + 2 + 9 * 11, limits.loop_trips);
      }
    }
  }
}

TEST(SitsPlan, SuitsTheDevice) {
  vulkan::Limits limits;
  limits.subgroup_size = 32;
  limits.loop_trips = UINT32_MAX;
  EXPECT_EQ(make_sits_plan(9, limits, {}).strategy, SitsStrategy::sweeps);
  limits.cpu = true;
  EXPECT_EQ(make_sits_plan(9, limits, {}).strategy, SitsStrategy::walk);
  GpuOptions options;
  options.submission_events = 77;
  EXPECT_EQ(make_sits_plan(9, limits, options).submission_events, 77u);
}

}  // namespace
}  // namespace scarf
