#include "core/batch_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr SensorSize kSensor = {10, 8};
constexpr int64_t kLimit = int64_t{1} << 48;
constexpr int64_t kMin = std::numeric_limits<int64_t>::min();
constexpr int64_t kMax = std::numeric_limits<int64_t>::max();

Event event(int64_t t, uint16_t x = 0, uint16_t y = 0, uint8_t p = 0) {
  return {t, x, y, p};
}

bool accepted(int64_t t_first, int64_t t) {
  const Event events[] = {event(t)};
  const bool later_batch = check_batch(events, kSensor, t_first).ok();
  const Event both[] = {event(t_first), event(t)};
  EXPECT_EQ(check_batch(both, kSensor, std::nullopt).ok(), later_batch);
  return later_batch;
}

TEST(BatchCheck, EmptyBatch) {
  const auto fresh = check_batch({}, kSensor, std::nullopt);
  ASSERT_TRUE(fresh.ok());
  EXPECT_EQ(fresh->outside, 0u);
  EXPECT_FALSE(fresh->t_first.has_value());
  const auto later = check_batch({}, kSensor, 7);
  ASSERT_TRUE(later.ok());
  EXPECT_EQ(later->t_first, 7);
}

TEST(BatchCheck, TheFirstEventInsideTheSensorSetsTheOrigin) {
  const Event events[] = {event(1, 10, 0), event(2, 0, 8), event(3, 9, 7), event(4, 65535, 65535), event(-5)};
  const auto batch = check_batch(events, kSensor, std::nullopt);
  ASSERT_TRUE(batch.ok());
  EXPECT_EQ(batch->outside, 3u);
  EXPECT_EQ(batch->t_first, 3);

  const auto later = check_batch(events, kSensor, 100);
  ASSERT_TRUE(later.ok());
  EXPECT_EQ(later->outside, 3u);
  EXPECT_EQ(later->t_first, 100);
}

TEST(BatchCheck, OnlyEventsOutside) {
  const Event events[] = {event(1, 10, 0), event(kMax, 0, 8, 2)};
  const auto batch = check_batch(events, kSensor, std::nullopt);
  ASSERT_TRUE(batch.ok());
  EXPECT_EQ(batch->outside, 2u);
  EXPECT_FALSE(batch->t_first.has_value());
}

TEST(BatchCheck, RefusesExactlyFromTheLimitOn) {
  for (const int64_t t_first : {int64_t{0}, int64_t{-1}, int64_t{1} << 51, -(int64_t{1} << 60)}) {
    EXPECT_TRUE(accepted(t_first, t_first));
    EXPECT_TRUE(accepted(t_first, t_first + kLimit - 1));
    EXPECT_TRUE(accepted(t_first, t_first - kLimit + 1));
    EXPECT_FALSE(accepted(t_first, t_first + kLimit));
    EXPECT_FALSE(accepted(t_first, t_first - kLimit));
  }
}

TEST(BatchCheck, ExtremeTimes) {
  EXPECT_TRUE(accepted(kMax, kMax - kLimit + 1));
  EXPECT_FALSE(accepted(kMax, kMax - kLimit));
  EXPECT_TRUE(accepted(kMin, kMin + kLimit - 1));
  EXPECT_FALSE(accepted(kMin, kMin + kLimit));
  EXPECT_FALSE(accepted(0, kMax));
  EXPECT_FALSE(accepted(0, kMin));
}

TEST(BatchCheck, OppositeEndsOfTimeAreFarApart) {
  EXPECT_FALSE(accepted(kMax, kMin));
  EXPECT_FALSE(accepted(kMin, kMax));
  EXPECT_FALSE(accepted(kMax - 5, kMin + 5));
}

TEST(BatchCheck, EventsOutsideNeverRefuse) {
  const Event events[] = {event(0), event(kMax, 10, 0), event(kMin, 0, 8, 2), event(1, 9, 7)};
  const auto batch = check_batch(events, kSensor, std::nullopt);
  ASSERT_TRUE(batch.ok()) << batch.error().message;
  EXPECT_EQ(batch->outside, 2u);
}

TEST(BatchCheck, RefusesPolaritiesAboveOne) {
  for (const int polarity : {2, 255}) {
    const Event events[] = {event(0), event(5, 3, 4, static_cast<uint8_t>(polarity))};
    const auto batch = check_batch(events, kSensor, std::nullopt);
    ASSERT_FALSE(batch.ok());
    EXPECT_EQ(batch.error().code, ErrorCode::refused_batch);
    EXPECT_THAT(batch.error().message,
                AllOf(HasSubstr("event 1 of the batch (t 5, x 3, y 4, p " + std::to_string(polarity)),
                      HasSubstr("must be 0 or 1")));
  }
  const Event first[] = {event(0, 0, 0, 2)};
  EXPECT_FALSE(check_batch(first, kSensor, std::nullopt).ok());
}

TEST(BatchCheck, NamesTheFirstOffendingEvent) {
  const Event events[] = {event(10), event(0, 99, 99, 9), event(10 + kLimit, 3, 4, 1), event(11, 0, 0, 2)};
  const auto batch = check_batch(events, kSensor, std::nullopt);
  ASSERT_FALSE(batch.ok());
  EXPECT_EQ(batch.error().code, ErrorCode::refused_batch);
  EXPECT_THAT(batch.error().message,
              AllOf(HasSubstr("event 2 of the batch (t 281474976710666, x 3, y 4, p 1)"),
                    HasSubstr("first event at t 10")));
}

}  // namespace
}  // namespace scarf
