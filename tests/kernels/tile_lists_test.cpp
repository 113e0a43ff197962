// The lists of events per tile against a plain loop.
#include "kernels/tile_lists.h"

#include <gtest/gtest.h>

#include <random>

#include "shaders/common/layout.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

using Lists = std::vector<std::vector<uint32_t>>;

Lists expected_lists(const TileListsPlan& plan, std::span<const Event> events) {
  Lists lists(plan.tiles());
  const auto tile = static_cast<int32_t>(plan.tile);
  const auto halo = static_cast<int32_t>(plan.halo);
  for (uint32_t i = 0; i < plan.tiles(); ++i) {
    const int32_t left = static_cast<int32_t>(i % plan.tiles_x) * tile;
    const int32_t top = static_cast<int32_t>(i / plan.tiles_x) * tile;
    for (uint32_t e = 0; e < events.size(); ++e) {
      const int32_t x = events[e].x;
      const int32_t y = events[e].y;
      if (!plan.sensor.contains(events[e])) continue;
      const bool near_x = left - halo <= x && x < left + tile + halo;
      const bool near_y = top - halo <= y && y < top + tile + halo;
      if (near_x && near_y) lists[i].push_back(e);
    }
  }
  return lists;
}

class TileListsTest : public test::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    commands_ = test::value_of(Commands::create(context_->vulkan(), context_->vulkan().compute()));
  }

  template <class T>
  Buffer host_buffer(uint64_t count) {
    return test::value_of(Buffer::create(context_->vulkan(), "test", count * sizeof(T), MemoryUse::readback));
  }

  // Lists of the events from `first` on, twice with the same memory.
  void compare(const TileListsPlan& plan, std::span<const Event> events, uint32_t first) {
    const Buffer staging = host_buffer<Event>(events.size());
    std::copy(events.begin(), events.end(), staging.mapped_as<Event>());
    TileLists lists;
    TileLists::Bound bound;
    PipelineBuilder builder(context_->vulkan());
    lists.build(builder, plan);
    lists.bind(builder, bound, staging);
    ASSERT_TRUE(builder.result()) << builder.result().error().message;
    const Buffer begins = host_buffer<uint32_t>(plan.table_words());
    const Buffer entries = host_buffer<uint32_t>(plan.list_words());
    for (uint32_t count : {static_cast<uint32_t>(events.size()) - first,
                           1 + (static_cast<uint32_t>(events.size()) - first) / 3}) {
      ASSERT_TRUE(commands_.begin());
      const layout::TileListsPush push = lists.record(commands_, bound, first, count);
      commands_.copy(lists.begins(), 0, begins, 0, begins.size());
      commands_.copy(lists.lists(), 0, entries, 0, entries.size());
      ASSERT_TRUE(commands_.submit() && commands_.wait());
      const Lists expected = expected_lists(plan, events.subspan(first, count));
      const auto* places = begins.mapped_as<uint32_t>();
      const auto* words = entries.mapped_as<uint32_t>();
      ASSERT_EQ(places[0], 0u);
      for (uint32_t i = 0; i < plan.tiles(); ++i) {
        const std::vector<uint32_t> list(words + places[i * push.chunks],
                                         words + places[(i + 1) * push.chunks]);
        ASSERT_EQ(list, expected[i]) << "tile " << i;
      }
    }
  }

  Commands commands_;
};

TEST_F(TileListsTest, EverySpread) {
  std::mt19937 random(1);
  for (test::Spread spread : test::kSpreads) {
    for (uint32_t tile : {16u, 32u}) {
      for (uint32_t halo : {0u, 4u, 31u}) {
        const SensorSize sensor = {1 + static_cast<int32_t>(random() % 150),
                                   1 + static_cast<int32_t>(random() % 100)};
        SCOPED_TRACE(testing::Message() << sensor.width << "x" << sensor.height << " tile " << tile
                                        << " halo " << halo << " spread " << static_cast<int>(spread));
        const auto events = test::make_stream(spread, sensor, 500 + random() % 2000, random());
        const TileListsPlan plan =
            make_tile_lists_plan(sensor, tile, halo, 2500, context_->vulkan().limits());
        ASSERT_NO_FATAL_FAILURE(compare(plan, events, static_cast<uint32_t>(random() % 100)));
      }
    }
  }
}

// Fewer tiles than a halo reaches over, and sizes around those of chunks.
TEST_F(TileListsTest, SmallSensorsAndSubmissions) {
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{3, 70}, SensorSize{40, 2}}) {
    for (uint32_t count : {1u, 63u, 64u, 65u, 129u}) {
      const auto events = test::make_stream(test::Spread::beyond, sensor, count, count);
      const TileListsPlan plan = make_tile_lists_plan(sensor, 16, 31, count, context_->vulkan().limits());
      ASSERT_NO_FATAL_FAILURE(compare(plan, events, 0));
    }
  }
}

TEST(TileListsPlan, StaysWithinTheLoopBudget) {
  vulkan::Limits limits;
  limits.loop_trips = 60'000;
  for (uint32_t tile : {8u, 16u, 32u, 64u}) {
    for (uint32_t halo : {0u, 1u, 4u, 31u}) {
      for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{1280, 720}, SensorSize{16'384, 16'384}}) {
        for (uint32_t events : {1u, 1u << 15, 1u << 20}) {
          const TileListsPlan plan = make_tile_lists_plan(sensor, tile, halo, events, limits);
          EXPECT_LE(place_trips(plan), limits.loop_trips);
          EXPECT_GE(plan.chunk_events, 32u);
        }
      }
    }
  }
}

}  // namespace
}  // namespace scarf
