// The time window, worked out by hand: pixels are on where last > T - w.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/representations.h"

namespace scarf::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr SensorSize kRow = {3, 1};
constexpr int64_t kMin = std::numeric_limits<int64_t>::min();
constexpr int64_t kMax = std::numeric_limits<int64_t>::max();

std::unique_ptr<Representation> window_of(int64_t window, const std::vector<Event>& events,
                                          SensorSize sensor = kRow) {
  return reference(TimeWindowParameters{.window = window}, sensor, events);
}

TEST(TimeWindow, BeforeAnyEvent) {
  const auto r = window_of(10, {});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 0, 0));
  EXPECT_THAT(u8_of(*r, 0), ElementsAre(0, 0, 0));
  EXPECT_THAT(u8_of(*r, kMin), ElementsAre(0, 0, 0));
  EXPECT_THAT(float_of(*r), ElementsAre(0, 0, 0));
  EXPECT_THAT(raw_of(*r), ElementsAre(kNeverFired, kNeverFired, kNeverFired));
  EXPECT_EQ(
      value_of(r->state()),
      StateBytes().add(std::vector<int64_t>{kNeverFired, kNeverFired, kNeverFired, kNeverFired}).bytes());
}

TEST(TimeWindow, TheOldEndIsOpen) {
  // T - w = 10 - 10 = 0: the event at 0 is out, the one at 1 is in.
  const auto r = window_of(10, {event(0, 0), event(1, 1), event(10, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255));
  EXPECT_THAT(float_of(*r), ElementsAre(0, 1, 1));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 10));
  EXPECT_EQ(value_of(r->state()), StateBytes().add(std::vector<int64_t>{10, 0, 1, 10}).bytes());
}

TEST(TimeWindow, ThirtyThreeMillisecondsByDefault) {
  const auto r = reference(TimeWindowParameters{}, kRow, {event(0, 0), event(1, 1), event(33'000, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255));
}

TEST(TimeWindow, TheSmallestWindowShowsTheNewestTime) {
  const auto r = window_of(1, {event(9, 0), event(10, 1), event(10, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255));
}

TEST(TimeWindow, AtAGivenTime) {
  const auto r = window_of(10, {event(0, 0), event(5, 1), event(10, 2)});
  EXPECT_THAT(u8_of(*r, 14), ElementsAre(0, 255, 255));  // last > 4
  EXPECT_THAT(u8_of(*r, 15), ElementsAre(0, 0, 255));    // last > 5
  EXPECT_THAT(u8_of(*r, 20), ElementsAre(0, 0, 0));
  EXPECT_THAT(u8_of(*r, 3), ElementsAre(255, 255, 255));  // last > -7; later events are not hidden
  EXPECT_THAT(float_of(*r, 15), ElementsAre(0, 0, 1));
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255));  // a given time is for one query only
}

TEST(TimeWindow, NewestIsTheLastToArrive) {
  // T = 50 although 100 came before: last > 40 for all three.
  auto r = window_of(10, {event(45, 0), event(100, 1), event(50, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 255, 255));
  // T = 100 again: only what is later than 90.
  ASSERT_TRUE(r->push(std::vector<Event>{event(100, 2)}));
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255));
}

TEST(TimeWindow, TheLastTimeIsTheLastToArrive) {
  // Pixel 0: 50, then 45. T - w = 100 - 52 = 48, so the pixel is off; with the largest of its times it would
  // be on.
  const auto r = window_of(52, {event(50, 0), event(45, 0), event(100, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(45, 100, kNeverFired));
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 0));
}

TEST(TimeWindow, EventsOutsideDoNotMoveTheTime) {
  const auto r = window_of(10, {event(1, 0), event(1'000, 3), event(2'000, 0, 1)});
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 0, 0));
}

TEST(TimeWindow, PolaritiesShareThePixel) {
  const auto r = window_of(10, {event(0, 0, 0, 1), event(20, 0, 0, 0), event(25, 1, 0, 0)});
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 255, 0));
  EXPECT_THAT(raw_of(*r), ElementsAre(20, 25, kNeverFired));
}

TEST(TimeWindow, RowsAreNotMixed) {
  const auto r = window_of(10, {event(1, 2, 0), event(2, 0, 1)}, {3, 2});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 0, 255, 255, 0, 0));
}

TEST(TimeWindow, TheEndsOfTime) {
  const auto early = window_of(33'000, {event(kMin + 5, 0), event(kMin + 9, 1)});
  EXPECT_THAT(u8_of(*early), ElementsAre(255, 255, 0));
  EXPECT_THAT(u8_of(*early, kMin), ElementsAre(255, 255, 0));
  EXPECT_THAT(u8_of(*early, kMax), ElementsAre(0, 0, 0));
  const auto late = window_of(33'000, {event(kMax - 33'000, 0), event(kMax, 1)});
  EXPECT_THAT(u8_of(*late), ElementsAre(0, 255, 0));
  EXPECT_THAT(u8_of(*late, kMin), ElementsAre(255, 255, 0));
}

TEST(TimeWindow, SparseEventsNeedCounts) {
  const auto r = window_of(10, {event(1, 0)});
  const auto events = r->events().wait();
  ASSERT_FALSE(events.ok());
  EXPECT_EQ(events.error().code, ErrorCode::illegal_parameter);
  EXPECT_THAT(events.error().message, AllOf(HasSubstr("scarf"), HasSubstr("aae"), HasSubstr("time_window")));
}

TEST(TimeWindow, TheWindowBelongsToTheInstance) {
  const std::vector<Event> events = {event(0, 0), event(5, 1), event(10, 2)};
  const auto wide = window_of(11, events);
  const auto narrow = window_of(5, events);
  EXPECT_THAT(u8_of(*wide), ElementsAre(255, 255, 255));
  EXPECT_THAT(u8_of(*narrow), ElementsAre(0, 0, 255));
  EXPECT_THAT(u8_of(*wide), ElementsAre(255, 255, 255));
}

std::unique_ptr<Representation> counts_of(int64_t window, const std::vector<Event>& events,
                                          double accumulation = kDefaultAccumulation) {
  return reference(TimeWindowParameters{.window = window, .counts = true, .accumulation = accumulation}, kRow,
                   events);
}

TEST(TimeWindowCounts, BeforeAnyEvent) {
  const auto r = counts_of(10, {});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 0, 0));
  EXPECT_THAT(float_of(*r, kMin), ElementsAre(0, 0, 0));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 0));
  EXPECT_THAT(value_of(r->events()), IsEmpty());
  EXPECT_EQ(value_of(r->state()), StateBytes().add(kNeverFired).add(uint64_t{0}).bytes());
}

TEST(TimeWindowCounts, EventsOfTheWindow) {
  // t > 10 - 10: the event at 0 is out. Brightness: 76.5 and 153, half to even.
  const auto r = counts_of(10, {event(0, 0), event(5, 0, 0, 0), event(10, 0), event(10, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(2, 1, 0));
  EXPECT_THAT(u8_of(*r), ElementsAre(153, 76, 0));
  EXPECT_THAT(float_of(*r), ElementsAre(0.6F, 0.3F, 0));
  const std::vector<Event> listed = {event(5, 0, 0, 0), event(10, 0), event(10, 1)};
  EXPECT_EQ(value_of(r->events()), listed);
  EXPECT_EQ(value_of(r->state()), StateBytes().add(int64_t{10}).add(uint64_t{3}).add(listed).bytes());
}

TEST(TimeWindowCounts, TheLargestTimeRules) {
  auto r = counts_of(10, {event(5, 0), event(10, 0), event(0, 2), event(1, 2)});
  // t_max = 10 although 1 came last: 0 is out and 1 is in.
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{event(5, 0), event(10, 0), event(1, 2)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(2, 0, 1));
  // t_max = 12: 1 leaves from behind the older arrivals 5 and 10.
  ASSERT_TRUE(r->push(std::vector<Event>{event(12, 1)}));
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{event(5, 0), event(10, 0), event(12, 1)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(2, 1, 0));
  EXPECT_EQ(value_of(r->state()), StateBytes()
                                      .add(int64_t{12})
                                      .add(uint64_t{3})
                                      .add(event(5, 0))
                                      .add(event(10, 0))
                                      .add(event(12, 1))
                                      .bytes());
}

TEST(TimeWindowCounts, AtAGivenTime) {
  const auto r = counts_of(10, {event(5, 0), event(10, 0), event(10, 1)});
  EXPECT_THAT(u8_of(*r, 14), ElementsAre(153, 76, 0));  // t > 4
  EXPECT_THAT(u8_of(*r, 15), ElementsAre(76, 76, 0));   // t > 5
  EXPECT_THAT(float_of(*r, 20), ElementsAre(0, 0, 0));
  EXPECT_THAT(u8_of(*r, kMax), ElementsAre(0, 0, 0));
  EXPECT_THAT(u8_of(*r, 0), ElementsAre(153, 76, 0));  // not earlier than t_max
  EXPECT_THAT(u8_of(*r), ElementsAre(153, 76, 0));
}

TEST(TimeWindowCounts, BrightnessOfManyEvents) {
  // 255.0 * 0.3 * 3 = 229.5 becomes 230, left to right; 255 * (0.3 * 3) would be less than 229.5.
  const auto three = counts_of(10, std::vector<Event>(3, event(1, 1)));
  EXPECT_THAT(u8_of(*three), ElementsAre(0, 230, 0));
  EXPECT_EQ(float_of(*three)[1], static_cast<float>(0.3 * 3.0));
  const auto many = counts_of(10, std::vector<Event>(100'000, event(1, 1)));
  EXPECT_THAT(u8_of(*many), ElementsAre(0, 255, 0));
  EXPECT_THAT(raw_of(*many), ElementsAre(0, 100'000, 0));
  EXPECT_EQ(float_of(*many)[1], static_cast<float>(0.3 * 100'000));  // not clipped, as SCARF's
  // 255 * 0.001 * 102 = 26.01.
  EXPECT_THAT(u8_of(*counts_of(10, std::vector<Event>(102, event(1, 1)), 0.001)), ElementsAre(0, 26, 0));
  EXPECT_THAT(u8_of(*counts_of(10, std::vector<Event>(3, event(1, 1)), 1)), ElementsAre(0, 255, 0));
}

TEST(TimeWindowCounts, TheEndsOfTime) {
  EXPECT_THAT(raw_of(*counts_of(33'000, {event(kMin + 5, 0), event(kMin + 9, 1)})), ElementsAre(1, 1, 0));
  EXPECT_THAT(raw_of(*counts_of(33'000, {event(kMax - 33'000, 0), event(kMax, 1)})), ElementsAre(0, 1, 0));
}

}  // namespace
}  // namespace scarf::test
