#include "io/base/event_tally.h"

#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::HasSubstr;

// Times of the events that come through, one call of keep() for every `step` events.
std::vector<int64_t> kept_times(EventTally& tally, std::vector<Event> events, size_t step) {
  std::vector<int64_t> times;
  for (size_t at = 0; at < events.size(); at += step) {
    const auto some = std::span(events).subspan(at, std::min(step, events.size() - at));
    const size_t kept = tally.keep(some);
    for (size_t i = 0; i < kept; ++i) times.push_back(some[i].t);
  }
  return times;
}

std::vector<Event> events_at(std::initializer_list<int64_t> times) {
  std::vector<Event> events;
  for (const int64_t t : times) events.push_back({t, 1, 1, 1});
  return events;
}

struct Expected {
  TimePolicy policy;
  std::vector<int64_t> times;
  uint64_t back_steps;
  int64_t largest;
  uint64_t dropped;
};

class TimePolicies : public ::testing::TestWithParam<Expected> {};

TEST_P(TimePolicies, GiveTheTimesTheyPromiseHoweverEventsCome) {
  const Expected& expected = GetParam();
  for (const size_t step : {1, 2, 6}) {
    ReadOptions options;
    options.time_policy = expected.policy;
    EventTally tally(SensorSize{4, 4}, options);
    EXPECT_EQ(kept_times(tally, events_at({10, 20, 15, 5, 25, 20}), step), expected.times);
    EXPECT_EQ(tally.report.events, expected.times.size());
    EXPECT_EQ(tally.report.back_steps, expected.back_steps);
    EXPECT_EQ(tally.report.largest_back_step, expected.largest);
    EXPECT_EQ(tally.report.dropped, expected.dropped);
    EXPECT_EQ(tally.failure().has_value(), expected.policy == TimePolicy::error);
  }
}

INSTANTIATE_TEST_SUITE_P(All, TimePolicies,
                         ::testing::Values(
                             // The step back of each from the event before it.
                             Expected{TimePolicy::keep, {10, 20, 15, 5, 25, 20}, 3, 10, 0},
                             // From the newest one so far.
                             Expected{TimePolicy::clamp, {10, 20, 20, 20, 25, 25}, 3, 15, 0},
                             Expected{TimePolicy::drop, {10, 20, 25}, 3, 15, 3},
                             Expected{TimePolicy::error, {10, 20}, 1, 5, 0}));

TEST(EventTally, AnEventOutsideTheSensorIsCountedOrEndsTheReading) {
  for (const OutOfSensor policy : {OutOfSensor::drop, OutOfSensor::error}) {
    ReadOptions options;
    options.out_of_sensor = policy;
    EventTally tally(SensorSize{4, 3}, options);
    std::vector<Event> events = {{1, 3, 2, 1}, {2, 4, 2, 1}, {3, 3, 3, 1}, {4, 0, 0, 0}};
    const size_t kept = tally.keep(events);
    if (policy == OutOfSensor::drop) {
      EXPECT_EQ(kept, 2u);
      EXPECT_EQ(tally.report.outside, 2u);
      EXPECT_EQ(events[1].t, 4);
    } else {
      EXPECT_EQ(kept, 1u);
      ASSERT_TRUE(tally.failure());
      EXPECT_THAT(tally.failure()->message, HasSubstr("event 1 (t 2, x 4, y 2)"));
      EXPECT_EQ(tally.keep(std::span(events).first(1)), 0u) << "nothing follows a failure";
    }
  }
}

// However the events come, and whatever becomes of them.
TEST(EventTally, StepsForwardThatAreTooLongAreJumps) {
  constexpr int64_t kStep = kLongestStep;
  const std::vector<Event> events = {{-5, 1, 1, 1},             // the first event follows none
                                     {kStep - 5, 1, 1, 1},      // as long as a step may be
                                     {2 * kStep - 4, 1, 1, 1},  // a jump
                                     {2 * kStep - 4, 1, 1, 1},  //
                                     {5 * kStep, 9, 9, 1},  // the largest one, to an event outside the sensor
                                     {4 * kStep, 1, 1, 1},  // a step back
                                     {4 * kStep + 1, 1, 1, 1},  //
                                     {7 * kStep + 5, 1, 1, 1},  // as large as the largest one: that stays
                                     {7 * kStep + 5 + kStep, 1, 1, 1}};  //
  for (const TimePolicy policy : {TimePolicy::keep, TimePolicy::clamp, TimePolicy::drop}) {
    for (const size_t step : {1, 2, 3, 9}) {
      ReadOptions options;
      options.time_policy = policy;
      options.time_shift = TimeShift::first_event;
      EventTally tally(SensorSize{4, 4}, options);
      kept_times(tally, events, step);
      const bool keep = policy == TimePolicy::keep;
      EXPECT_EQ(tally.report.jumps, 3u);
      EXPECT_EQ(tally.report.largest_jump, 3 * kStep + 4);
      EXPECT_EQ(tally.report.largest_jump_from, 2 * kStep - 4);
      EXPECT_EQ(tally.report.back_steps, keep ? 1u : 2u);
    }
  }
  EventTally hostile(std::nullopt, {});
  kept_times(hostile,
             events_at({std::numeric_limits<int64_t>::min() + 1, std::numeric_limits<int64_t>::max()}), 2);
  EXPECT_EQ(hostile.report.jumps, 1u);
  EXPECT_EQ(hostile.report.largest_jump, std::numeric_limits<int64_t>::max());
}

TEST(EventTally, ShiftsAreSubtractedFromEveryTime) {
  ReadOptions options;
  options.time_shift = TimeShift::first_event;
  EventTally first_event(SensorSize{4, 4}, options);
  // The first event is one that is handed out: not the one outside.
  std::vector<Event> events = {{7, 9, 9, 1}, {10, 1, 1, 1}, {8, 1, 1, 1}, {14, 1, 1, 1}};
  EXPECT_EQ(kept_times(first_event, events, 2), (std::vector<int64_t>{0, -2, 4}));

  options.time_shift = TimeShift::first_high;
  EventTally first_high(SensorSize{4, 4}, options);
  first_high.set_first_high(6);
  first_high.set_first_high(100);  // only the first counts
  EXPECT_EQ(kept_times(first_high, events_at({10, 12}), 1), (std::vector<int64_t>{4, 6}));
}

TEST(EventTally, DamageIsNotedAndAFailureOnlyWhenStrict) {
  ReadOptions options;
  EventTally lenient(std::nullopt, options);
  lenient.note_damage(17, "a packet is broken");
  lenient.note_damage(99, "another");
  EXPECT_EQ(lenient.report.damages, 2u);
  EXPECT_EQ(lenient.report.damage->byte, 17u);
  EXPECT_FALSE(lenient.failure());

  options.strict = true;
  EventTally strict(std::nullopt, options);
  strict.note_damage(17, "a packet is broken");
  ASSERT_TRUE(strict.failure());
  EXPECT_THAT(strict.failure()->message, HasSubstr("byte 17: a packet is broken"));
}

TEST(Strict, UnknownWordsAndTruncatedBytesEndTheReadingWithTheirPlace) {
  ReadOptions strict;
  strict.strict = true;
  // TIME_HIGH, an event, a word of a reserved type, an event, half a word.
  const Bytes unknown = evt2_file({0x80000001, 0x00000000, 0x30000000, 0x00000000});
  EXPECT_EQ(read_all(unknown).events.size(), 2u);
  const Recording refused = read_all(unknown, strict);
  EXPECT_THAT(refused.error, HasSubstr("evt2 does not define"));
  Bytes cut = evt2_file({0x80000001, 0x00000000});
  cut.push_back(0);
  const Recording truncated = read_all(cut, strict);
  EXPECT_EQ(truncated.events.size(), 1u) << "what is intact comes first";
  EXPECT_THAT(truncated.error, HasSubstr("the last 1 bytes"));
}

TEST(Options, ThatAFormatHasNoUseForAreRefused) {
  ReadOptions options;
  options.columns = "xypt";
  EXPECT_THAT(read_all(evt2_file({0x80000001, 0}), options).error,
              HasSubstr("ReadOptions::columns is not used by evt2"));
  options = {};
  options.format = "nonsense";
  EXPECT_THAT(read_all(evt2_file({0x80000001, 0}), options).error, HasSubstr("there are"));
}

}  // namespace
}  // namespace scarf
