// AAE on the device: blocks may differ from the reference only where a test came so near to its threshold
// that rounding decides. The reference's walk says where that is; the streams here never come there.
#include "cpu_ref/aae.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

class Aae : public test::DeviceTest {
 protected:
  void make(const AaeParameters& parameters, SensorSize sensor, const GpuOptions& options = {}) {
    parameters_ = parameters;
    device_ = test::value_of(make_gpu_representation(context_, parameters, sensor, options));
    reference_ = test::value_of(make_reference_representation(parameters, sensor));
    ASSERT_TRUE(device_ && reference_);
  }
  void push(std::span<const Event> events) { ASSERT_TRUE(device_->push(events) && reference_->push(events)); }
  void compare() {
    ASSERT_FALSE(may_differ());
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device_, *reference_));
  }

  // Whether rounding may decide where the next walk through some block ends.
  bool may_differ() {
    const SensorSize sensor = reference_->sensor();
    const int32_t width = parameters_.esvo2 ? (sensor.width + 7) / 8 : parameters_.block;
    const int32_t height = parameters_.esvo2 ? (sensor.height + 5) / 6 : parameters_.block;
    std::map<std::pair<int32_t, int32_t>, std::vector<Event>> queues;
    for (const Event& e : test::value_of(reference_->events()))
      queues[{e.y / height, e.x / width}].push_back(e);
    return std::any_of(queues.begin(), queues.end(), [this](const auto& queue) {
      return (parameters_.esvo2 ? walk_block_esvo2(queue.second) : walk_block(queue.second)).close;
    });
  }

  AaeParameters parameters_;
  std::unique_ptr<GpuRepresentation> device_;
  std::unique_ptr<Representation> reference_;
};

const AaeParameters kVariants[] = {{},
                                   {.keep = true},
                                   {.block = 1},
                                   {.block = 1, .keep = true},
                                   {.block = 7},
                                   {.block = 1024},
                                   {.block = 1024, .keep = true},
                                   {.esvo2 = true},
                                   {.keep = true, .esvo2 = true}};

TEST_F(Aae, SpreadsAndVariants) {
  std::mt19937 random(1);
  size_t next_spread = 0;
  for (const AaeParameters& parameters : kVariants) {
    for (int trial = 0; trial < 4; ++trial) {
      const Spread spread = test::kSpreads[next_spread++ % std::size(test::kSpreads)];
      SCOPED_TRACE(static_cast<int>(spread));
      GpuOptions options;
      options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 700);
      const SensorSize sensor = {61, 37};
      make(parameters, sensor, options);
      const auto events = make_stream(spread, sensor, 2500, random());
      for (size_t done = 0; done < events.size();) {
        const size_t n = random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % 900);
        ASSERT_NO_FATAL_FAILURE(push(std::span(events).subspan(done, n)));
        done += n;
        ASSERT_NO_FATAL_FAILURE(compare());
      }
    }
  }
}

TEST_F(Aae, TinyAndOddSensors) {
  std::mt19937 random(2);
  for (const AaeParameters& parameters : kVariants) {
    for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{9, 7}}) {
      make(parameters, sensor);
      for (size_t size : {0, 1, 2, 11, 300}) {
        ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::beyond, sensor, size, random())));
        ASSERT_NO_FATAL_FAILURE(compare());
      }
    }
  }
}

// More blocks than one pass of the sort has digits.
TEST_F(Aae, ManyBlocks) {
  std::mt19937 random(3);
  const SensorSize sensor = {150, 101};
  for (bool keep : {false, true}) {
    make({.block = 1, .keep = keep}, sensor);
    for (int batch = 0; batch < 3; ++batch) {
      ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::uniform, sensor, 20'000, random())));
      ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::alternating, sensor, 3'000, random())));
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

// Equal times: the mean distance is 0, so the walk goes to the end of the queue. Longer queues than one
// dispatch walks, longer than the log has room for, and longer than a queue may be.
TEST_F(Aae, LongWalksThroughFullQueues) {
  const SensorSize sensor = {20, 16};
  for (const AaeParameters& parameters :
       {AaeParameters{}, AaeParameters{.keep = true}, AaeParameters{.keep = true, .esvo2 = true}}) {
    make(parameters, sensor);
    for (size_t size : {32'767, 2, 70'000, 60'000}) {
      std::vector<Event> events = make_stream(Spread::corners, sensor, size, size);
      for (Event& e : events) {
        e.x = static_cast<uint16_t>(e.x == 0 ? 1 : 2);
        e.y = 3;
        e.t = 1'000'000;
      }
      ASSERT_NO_FATAL_FAILURE(push(events));
      ASSERT_EQ(test::value_of(device_->state()), test::value_of(reference_->state()));
      if (size > 60'000) continue;  // no query: the queue gets too long
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

// Without queries the log keeps the newest 100,000 events of each block only.
TEST_F(Aae, DropsWhatQueuesHaveNoRoomFor) {
  GpuOptions options;
  options.submission_events = 50'000;
  const SensorSize sensor = {30, 15};
  for (int32_t block : {15, 1024}) {
    make({.block = block}, sensor, options);
    for (int batch = 0; batch < 6; ++batch) {
      ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::uniform, sensor, 60'000, batch, 100'000 * batch)));
    }
    ASSERT_EQ(test::value_of(device_->state()), test::value_of(reference_->state()));
    ASSERT_NO_FATAL_FAILURE(compare());
    // Later queries tell the log how short it is.
    EXPECT_LT(device_->memory_bytes(), 40u << 20);
  }
}

TEST_F(Aae, ResetStartsANewStream) {
  const SensorSize sensor = {50, 40};
  for (bool esvo2 : {false, true}) {
    make({.esvo2 = esvo2}, sensor);
    for (int64_t t_begin : {int64_t{0}, int64_t{1} << 60, -(int64_t{1} << 60)}) {
      const auto events = make_stream(Spread::moving_edge, sensor, 3000, 9, t_begin);
      ASSERT_NO_FATAL_FAILURE(push(events));
      ASSERT_NO_FATAL_FAILURE(compare());
      ASSERT_TRUE(device_->push(events));
      ASSERT_TRUE(device_->reset() && reference_->reset());
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
}

}  // namespace
}  // namespace scarf
