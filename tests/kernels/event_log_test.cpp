// The log of events on a device, by itself: against a vector that does the same.
#include "kernels/event_log.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "layout/words.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

constexpr SensorSize kSensor = {40, 30};
constexpr uint32_t kMostAtOnce = 3000;

class EventLogTest : public test::DeviceTest, protected EventLogOwner {
 protected:
  void make(uint32_t first_events, uint32_t most_events = UINT32_MAX / 2) {
    EventLog::Shape shape;
    shape.sensor = kSensor;
    shape.first_events = first_events;
    shape.most_events = most_events;
    shape.keep = layout::kKeepSince;
    shape.advice = "ask more often";
    log_ = test::value_of(EventLog::create(context_->vulkan(), shape, *this));
    ASSERT_NE(log_, nullptr);
    auto staging = vulkan::Buffer::create(context_->vulkan(), "the events of the test",
                                          kMostAtOnce * sizeof(Event), vulkan::MemoryUse::upload);
    ASSERT_TRUE(staging);
    staging_ = std::move(*staging);
    input_ = test::value_of(log_->bind_input(staging_));
    ASSERT_NE(input_, nullptr);
    reset();
  }

  void reset() {
    ASSERT_TRUE(log_->run([&](vulkan::Commands& c) { log_->record_reset(c); }));
    expected_.clear();
  }

  Result<void> append(std::span<const Event> events, uint32_t first = 0) {
    const auto count = static_cast<uint32_t>(events.size());
    if (auto r = log_->prepare(count); !r) return r;
    std::memcpy(staging_.mapped_as<Event>() + first, events.data(), events.size_bytes());
    if (count == 0) return {};
    if (auto r = log_->run([&](vulkan::Commands& c) { log_->record_append(c, *input_, first, count); }); !r)
      return r;
    for (const Event& e : events) {
      if (kSensor.contains(e)) expected_.push_back(e);
    }
    return {};
  }

  Result<void> drop_old_events() override {
    drops_ += 1;
    const int64_t since = since_;
    std::erase_if(expected_, [since](const Event& e) { return e.t < since; });
    layout::EventLogPush push{};
    push.since_low = low_word(since);
    push.since_high = high_word(since);
    return log_->run([&](vulkan::Commands& c) {
      log_->record_keep(c, EventLog::From::events, push);
      log_->record_copy_back(c);
    });
  }

  Result<void> bind_log(const EventLogMemory& memory) override {
    bound_capacity_ = memory.capacity;
    return {};
  }

  std::vector<Event> content() {
    const uint32_t bound = log_->bound();
    auto events = vulkan::Buffer::create(context_->vulkan(), "the copy", (bound + 1) * sizeof(Event),
                                         vulkan::MemoryUse::readback);
    auto length = vulkan::Buffer::create(context_->vulkan(), "the length", 4, vulkan::MemoryUse::readback);
    EXPECT_TRUE(events && length);
    EXPECT_TRUE(log_->run([&](vulkan::Commands& c) {
      c.copy(log_->events(), 0, *events, 0, bound * sizeof(Event));
      c.copy(log_->length(), 0, *length, 0, 4);
    }));
    return events_of(events->mapped(), length->mapped());
  }

  void compare() {
    const std::vector<Event> events = content();
    ASSERT_LE(events.size(), log_->bound());
    ASSERT_EQ(events, expected_);
    int64_t largest = INT64_MIN;
    for (const Event& e : expected_) largest = std::max(largest, e.t);
    ASSERT_EQ(test::value_of(log_->largest_time()), largest);
  }

  vulkan::Buffer staging_;
  std::unique_ptr<EventLog> log_;
  std::unique_ptr<EventLog::Input> input_;
  std::vector<Event> expected_;
  int64_t since_ = INT64_MIN;
  int drops_ = 0;
  uint32_t bound_capacity_ = 0;
};

TEST_F(EventLogTest, KeepsTheOrderOfArrival) {
  make(20'000);
  std::mt19937 random(1);
  ASSERT_NO_FATAL_FAILURE(compare());
  for (const Spread spread : test::kSpreads) {
    for (size_t size : {1, 31, 32, 33, 63, 64, 65, 2047}) {
      const auto first = static_cast<uint32_t>(random() % 900);
      ASSERT_TRUE(append(make_stream(spread, kSensor, size, random()), first));
    }
    ASSERT_NO_FATAL_FAILURE(compare());
    reset();
  }
  EXPECT_EQ(drops_, 0);
}

TEST_F(EventLogTest, GrowsWhenNothingCanBeDropped) {
  make(1);
  std::mt19937 random(2);
  for (size_t size : {1, 1, 2, 3, 500, 3000, 17, 3000, 3000}) {
    ASSERT_TRUE(append(make_stream(Spread::beyond, kSensor, size, random())));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
  EXPECT_EQ(log_->memory().capacity, bound_capacity_);
  EXPECT_GE(bound_capacity_, expected_.size());
  EXPECT_LE(bound_capacity_, 8 * expected_.size());
}

TEST_F(EventLogTest, DropsInsteadOfGrowing) {
  make(4096);
  std::mt19937 random(3);
  int64_t t = 0;
  for (int batch = 0; batch < 30; ++batch) {
    ASSERT_TRUE(append(make_stream(Spread::uniform, kSensor, 900, random(), t)));
    t = expected_.back().t;
    since_ = t - 500;
    if (batch % 7 == 0) {
      ASSERT_NO_FATAL_FAILURE(compare());
    }
  }
  EXPECT_GT(drops_, 3);
  EXPECT_EQ(log_->memory().capacity, 4096u);
}

TEST_F(EventLogTest, SaysWhenItIsFullAndLosesNothing) {
  make(64, 1000);
  ASSERT_TRUE(append(make_stream(Spread::uniform, kSensor, 900, 4)));
  const auto refused = append(make_stream(Spread::uniform, kSensor, 101, 5));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_memory);
  EXPECT_NE(refused.error().message.find("1001 events"), std::string::npos) << refused.error().message;
  EXPECT_NE(refused.error().message.find("at most 1000; ask more often"), std::string::npos);
  ASSERT_NO_FATAL_FAILURE(compare());
  ASSERT_TRUE(append(make_stream(Spread::uniform, kSensor, 100, 6)));
  ASSERT_NO_FATAL_FAILURE(compare());
}

TEST_F(EventLogTest, EventsOutsideTakeNoRoom) {
  make(3004, 3004);
  const Event outside = {1, 40, 0, 1, {}};
  const Event inside = {2, 39, 29, 1, {}};
  for (int batch = 0; batch < 5; ++batch) {
    ASSERT_TRUE(append(std::vector<Event>(2999, outside)));
    ASSERT_TRUE(append(std::vector<Event>(1, inside)));
  }
  ASSERT_EQ(expected_.size(), 5u);
  ASSERT_NO_FATAL_FAILURE(compare());
  EXPECT_EQ(drops_, 0);
}

TEST_F(EventLogTest, QueriesTellTheLength) {
  make(8000);
  ASSERT_TRUE(append(make_stream(Spread::beyond, kSensor, 1000, 7)));
  EXPECT_EQ(log_->bound(), 1000u);
  const auto older = log_->length_reader();
  const auto older_length = static_cast<uint32_t>(expected_.size());
  ASSERT_TRUE(append(make_stream(Spread::beyond, kSensor, 100, 8)));
  const auto newer = log_->length_reader();
  const auto newer_length = static_cast<uint32_t>(expected_.size());
  older(&older_length);
  EXPECT_EQ(log_->bound(), older_length + 100);
  newer(&newer_length);
  EXPECT_EQ(log_->bound(), newer_length);
  older(&older_length);  // late
  EXPECT_EQ(log_->bound(), newer_length);
  const auto before_reset = log_->length_reader();
  reset();
  ASSERT_TRUE(append(make_stream(Spread::uniform, kSensor, 50, 9)));
  const uint32_t nothing = 0;
  before_reset(&nothing);
  EXPECT_EQ(log_->bound(), 50u);
  ASSERT_NO_FATAL_FAILURE(compare());
}

}  // namespace
}  // namespace scarf
