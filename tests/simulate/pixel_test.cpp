#include "simulate/pixel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scarf/core/event.h"

namespace scarf::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int32_t kThreshold = kLogUnit / 4;

class PixelTest : public ::testing::Test {
 protected:
  void follow(int64_t t0, int64_t t1, int32_t log0, int32_t log1) {
    pixel_.follow({t0, t1, log0, log1}, refractory_, [this](int64_t t, bool on) {
      events_.push_back({t, 0, 0, on});
    });
  }

  Pixel pixel_{0, kThreshold, kThreshold};
  int64_t refractory_ = 0;
  std::vector<Event> events_;
};

TEST_F(PixelTest, RampGivesOneEventPerThreshold) {
  follow(0, 1000, 0, 4 * kThreshold);
  EXPECT_THAT(events_, ElementsAre(Event{250, 0, 0, 1}, Event{500, 0, 0, 1}, Event{750, 0, 0, 1},
                                   Event{1000, 0, 0, 1}));
}

TEST_F(PixelTest, ManyStepsGiveTheSameAsOne) {
  for (int64_t t = 0; t < 1000; t += 10) {
    const auto log = [](int64_t time) { return static_cast<int32_t>(-9 * kThreshold * time / 1000); };
    follow(t, t + 10, log(t), log(t + 10));
  }
  ASSERT_EQ(events_.size(), 9u);
  for (size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(events_[i].p, 0);
    EXPECT_NEAR(static_cast<double>(events_[i].t), 1000.0 * static_cast<double>(i + 1) / 9, 1.0);
  }
}

TEST_F(PixelTest, LessThanAThresholdGivesNone) {
  follow(0, 1000, 0, kThreshold - 1);
  EXPECT_THAT(events_, IsEmpty());
  follow(1000, 2000, kThreshold - 1, kThreshold);
  EXPECT_THAT(events_, ElementsAre(Event{2000, 0, 0, 1}));
}

TEST_F(PixelTest, TimesAreInterpolatedAndRoundedUp) {
  follow(100, 103, 0, 2 * kThreshold);  // crosses at 101.5 and 103
  EXPECT_THAT(events_, ElementsAre(Event{102, 0, 0, 1}, Event{103, 0, 0, 1}));
  events_.clear();
  follow(103, 106, 2 * kThreshold, 0);
  EXPECT_THAT(events_, ElementsAre(Event{105, 0, 0, 0}, Event{106, 0, 0, 0}));
}

TEST_F(PixelTest, ThresholdsOfBothPolaritiesAreSeparate) {
  pixel_ = Pixel(0, kThreshold, 2 * kThreshold);
  follow(0, 1000, 0, kThreshold);
  follow(1000, 2000, kThreshold, -kThreshold);
  EXPECT_THAT(events_, ElementsAre(Event{1000, 0, 0, 1}, Event{2000, 0, 0, 0}));
}

TEST_F(PixelTest, BlindDuringTheRefractoryTimeAndComparesWithWhatItSeesThen) {
  refractory_ = 300;
  follow(0, 1000, 0, 8 * kThreshold);  // a threshold per 125 us
  // 125, blind to 425, next 550, blind to 850, next 975.
  EXPECT_THAT(events_, ElementsAre(Event{125, 0, 0, 1}, Event{550, 0, 0, 1}, Event{975, 0, 0, 1}));
  events_.clear();
  follow(1000, 1100, 8 * kThreshold, 0);  // all of it unseen
  follow(2000, 3000, 0, kThreshold);
  EXPECT_THAT(events_, ElementsAre(Event{3000, 0, 0, 1}));
}

TEST_F(PixelTest, FiringBlindsToo) {
  refractory_ = 300;
  EXPECT_TRUE(pixel_.fire(100, refractory_));
  EXPECT_FALSE(pixel_.fire(400, refractory_));
  EXPECT_TRUE(pixel_.fire(401, refractory_));
  follow(401, 801, 0, 4 * kThreshold);  // awake at 701, level 3
  EXPECT_THAT(events_, ElementsAre(Event{801, 0, 0, 1}));
}

TEST(LogTable, IsTheNaturalLogarithm) {
  const auto table = log_table();
  ASSERT_EQ(table.size(), 65536u);
  for (size_t i = 0; i < table.size(); ++i) {
    ASSERT_NEAR(table[i], std::log(static_cast<double>(i) + 1) * kLogUnit, 0.501) << i;
  }
}

}  // namespace
}  // namespace scarf::simulate
