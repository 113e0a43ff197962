// AAE: walks through hand-worked queues.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/representations.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr SensorSize kRow = {6, 1};  // one block of 15

std::unique_ptr<Representation> aae(const std::vector<Event>& events, SensorSize sensor = kRow) {
  return reference(AaeParameters{}, sensor, events);
}

// An event every `step` microseconds, the v-th at pixel v.
std::vector<Event> steady(int32_t count, int64_t step) {
  std::vector<Event> events;
  for (int32_t v = 0; v < count; ++v) events.push_back(event(v * step, v));
  return events;
}

std::vector<Event> newest(const std::vector<Event>& events, size_t count) {
  return {events.end() - static_cast<std::ptrdiff_t>(count), events.end()};
}

TEST(Aae, BeforeAnyEvent) {
  const auto r = aae({}, {20, 17});
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(float_of(*r), Each(0));
  EXPECT_THAT(raw_of(*r), Each(0));
  EXPECT_THAT(value_of(r->events()), IsEmpty());
  // Blocks of 15 on 20x17: two by two.
  EXPECT_EQ(value_of(r->state()), StateBytes().add(uint32_t{4}).add(std::vector<uint32_t>(4)).bytes());
}

TEST(Aae, OneEventIsNotDrawnAndForgotten) {
  // n = 1: the walk ends at v = 1, so it does not begin.
  const auto r = aae({event(7, 2)});
  EXPECT_EQ(value_of(r->events()), std::vector<Event>{event(7, 2)});
  EXPECT_THAT(raw_of(*r), Each(0));
  EXPECT_THAT(value_of(r->events()), IsEmpty());
}

TEST(Aae, AWalkWithoutStop) {
  // m = 1 ms: a_conv = 31.6, while a grows by less than 1 per event. All but the oldest are drawn and kept.
  const auto events = steady(5, 1'000);
  const auto r = aae(events);
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 102, 102, 102, 102, 0));  // 255 * 0.4
  EXPECT_EQ(value_of(r->events()), newest(events, 4));
  EXPECT_THAT(float_of(*r), ElementsAre(0, 0, 0.4F, 0.4F, 0.4F, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 3));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 0, 1, 1, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 2));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 0, 0, 1, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 1));
  EXPECT_THAT(raw_of(*r), Each(0));
  EXPECT_THAT(value_of(r->events()), IsEmpty());
}

TEST(Aae, StopAtTheFirstEvent) {
  // m = 1 s: a_conv = 1, and a = 1 at once. The newest is drawn and nothing is kept.
  const auto r = aae(steady(3, 1'000'000));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_THAT(value_of(r->events()), IsEmpty());
}

// Five events with steps of 0.34, 0.4, 0.5, 0.2 s: m = 1.44 s / 4 = 0.36 s, a_conv = 1 / 0.6 = 1.66667.
//   v = 4, d = 0.2: a = 0 / 1 + 1 = 1,          40 % off
//   v = 3, d = 0.5: a = 1 / 1.5 + 1 = 1.66667,   0 % off: stop
std::vector<Event> five(int64_t t2) {
  return {event(0, 0), event(340'000, 1), event(t2, 2), event(1'240'000, 3), event(1'440'000, 4)};
}

TEST(Aae, StopWithinTwoPercent) {
  auto r = aae(five(740'000));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 0, 1, 1, 0));
  // One event was passed before the stop.
  EXPECT_EQ(value_of(r->events()), newest(five(740'000), 1));
  // The next event finds it: n = 2, m = 0.1 s, a_conv = 3.16, no stop at a = 1.
  ASSERT_TRUE(r->push(std::vector<Event>{event(1'540'000, 5)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 0, 0, 0, 0, 1));
  EXPECT_EQ(value_of(r->events()), std::vector<Event>{event(1'540'000, 5)});

  // t2 moves the step of v = 3, and not m. 0.428912 s: a = 1.69983, 1.99 % off: stop.
  EXPECT_THAT(raw_of(*aae(five(811'088))), ElementsAre(0, 0, 0, 1, 1, 0));
  // 0.428231 s: a = 1.70017, 2.01 % off. v = 2, d = 0.471769: 1.70017 / 1.80209 + 1 = 1.94344, 17 % off. v =
  // 1, d = 0.34: 1.94344 / 1.66077 + 1 = 2.17021, 30 % off. No stop.
  const auto to_the_end = aae(five(811'769));
  EXPECT_THAT(raw_of(*to_the_end), ElementsAre(0, 1, 1, 1, 1, 0));
  EXPECT_EQ(value_of(to_the_end->events()), newest(five(811'769), 4));
  // Below a_conv: 0.56 s: a = 1.64103, 1.5 % off: stop. 0.59 s: a = 1.62893, 2.3 % off: on.
  EXPECT_THAT(raw_of(*aae(five(680'000))), ElementsAre(0, 0, 0, 1, 1, 0));
  EXPECT_EQ(raw_of(*aae(five(650'000)))[2], 1);
}

TEST(Aae, EqualTimesNeverStop) {
  const std::vector<Event> events = {event(5, 0), event(5, 1), event(5, 2), event(5, 3)};
  const auto r = aae(events);
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 1, 1, 0, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 3));
}

TEST(Aae, BackwardTimesNeverStop) {
  // m = -1 s, so a_conv = 0. a runs through 1, 1/0 + 1 and what becomes of that.
  const std::vector<Event> events = {event(3'000'000, 0), event(2'000'000, 1), event(1'000'000, 2),
                                     event(0, 3)};
  const auto r = aae(events);
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 1, 1, 0, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 3));
}

TEST(Aae, OnlyTheEndsOfTheQueueMakeTheMean) {
  // A step back in the middle: m = (2 s - 0) / 2 = 1 s, a_conv = 1: stop at once.
  EXPECT_THAT(raw_of(*aae({event(0, 0), event(-500'000, 1), event(2'000'000, 2)})),
              ElementsAre(0, 0, 1, 0, 0, 0));
}

TEST(Aae, DrawsOfAPixelAddUp) {
  // Equal times: all but the oldest are drawn. 0.4 * 2 * 255 = 204; 1.2 is clipped in the byte only.
  const auto events = [](size_t n) { return std::vector<Event>(n, event(0, 1)); };
  EXPECT_EQ(u8_of(*aae(events(3)))[1], 204);
  EXPECT_EQ(u8_of(*aae(events(4)))[1], 255);
  EXPECT_EQ(float_of(*aae(events(4)))[1], static_cast<float>(0.4 * 3));
  EXPECT_EQ(float_of(*aae(events(1'001)))[1], 400.0F);
  EXPECT_EQ(raw_of(*aae(events(1'001)))[1], 1'000);
}

TEST(Aae, PolaritiesShareAQueue) {
  const std::vector<Event> events = {event(0, 0, 0, 0), event(1, 1, 0, 1), event(2, 2, 0, 0)};
  const auto r = aae(events);
  EXPECT_EQ(value_of(r->events()), events);
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 1, 0, 0, 0));
  EXPECT_EQ(value_of(r->events()), newest(events, 2));
}

TEST(Aae, BlocksOfFifteenUpToTheBorder) {
  // 20x17: the second column of blocks has 5 pixels, the second row 2. Three events of equal time in each.
  const Event a = event(0, 14, 14);
  const Event b = event(0, 15, 14);
  const Event c = event(0, 14, 15);
  const Event d = event(0, 19, 16);
  const auto r = aae({d, a, b, c, a, d, c, b, a, d}, {20, 17});
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{a, a, a, b, b, c, c, d, d, d}));
  EXPECT_EQ(value_of(r->state()), StateBytes()
                                      .add(uint32_t{4})
                                      .add(uint32_t{3})
                                      .add(std::vector<Event>{a, a, a})
                                      .add(uint32_t{2})
                                      .add(std::vector<Event>{b, b})
                                      .add(uint32_t{2})
                                      .add(std::vector<Event>{c, c})
                                      .add(uint32_t{3})
                                      .add(std::vector<Event>{d, d, d})
                                      .bytes());
  const Image<int64_t> raw = value_of(r->raw_image());
  EXPECT_EQ(raw.at(14, 14), 2);
  EXPECT_EQ(raw.at(15, 14), 1);
  EXPECT_EQ(raw.at(14, 15), 1);
  EXPECT_EQ(raw.at(19, 16), 2);
}

TEST(Aae, BlocksHaveTheirOwnPace) {
  // Blocks of 3 pixels: the left one stops at its first event (1 s), the right one does not (1 ms).
  const auto r = reference(AaeParameters{.block = 3}, kRow,
                           {event(0, 0), event(0, 3), event(1'000, 4), event(2'000, 5), event(1'000'000, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 0, 0, 1, 1));
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{event(1'000, 4), event(2'000, 5)}));
}

TEST(Aae, BlocksOfOnePixelAndOfTheWholeSensor) {
  const std::vector<Event> events = {event(0, 0), event(0, 5), event(0, 0), event(0, 5)};
  EXPECT_THAT(raw_of(*reference(AaeParameters{.block = 1}, kRow, events)), ElementsAre(1, 0, 0, 0, 0, 1));
  EXPECT_THAT(raw_of(*reference(AaeParameters{.block = 1'024}, kRow, events)), ElementsAre(1, 0, 0, 0, 0, 2));
}

TEST(Aae, AQueueHoldsAHundredThousand) {
  std::vector<Event> events(100'003, event(0, 1));
  for (size_t i = 0; i < 5; ++i) events[i] = event(0, 0, 0, static_cast<uint8_t>(i % 2));
  events.push_back(event(0, 5, 16));  // another block is not full
  const auto r = aae(events, {6, 17});
  auto kept = value_of(r->events());
  ASSERT_EQ(kept.size(), 100'001U);
  EXPECT_EQ(kept[0], event(0, 0, 0, 1));  // the first three are gone
  EXPECT_EQ(kept[1], event(0, 0, 0, 0));
  EXPECT_EQ(kept[2], event(0, 1));
  EXPECT_EQ(kept[100'000], event(0, 5, 16));
  const Image<int64_t> raw = value_of(r->raw_image());
  EXPECT_EQ(raw.at(0, 0), 1);  // its older event is the oldest of all
  EXPECT_EQ(raw.at(1, 0), 99'998);
  EXPECT_EQ(value_of(r->events()).size(), 99'999U);
}

TEST(Aae, TheLimitIsCheckedAtEveryEvent) {
  // Each new event pushes one old one out, also when they come in batches.
  const auto r = aae(std::vector<Event>(100'000, event(0, 0)));
  std::vector<Event> more;
  for (int64_t t = 1; t <= 99'999; ++t) more.push_back(event(t, 1));
  ASSERT_TRUE(r->push(more));
  EXPECT_EQ(value_of(r->events()).front(), event(0, 0));
  ASSERT_TRUE(r->push(std::vector<Event>{event(100'000, 2)}));
  EXPECT_EQ(value_of(r->events()).front(), event(1, 1));
  EXPECT_EQ(value_of(r->events()).size(), 100'000U);
}

TEST(Aae, EveryPictureCutsAndTheRestDoesNot) {
  const auto events = steady(6, 1'000);
  const auto r = aae(events);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(value_of(r->events()), events);
    EXPECT_EQ(value_of(r->state()), StateBytes().add(uint32_t{1}).add(uint32_t{6}).add(events).bytes());
  }
  (void)u8_of(*r);
  EXPECT_EQ(value_of(r->events()).size(), 5U);
  (void)float_of(*r, 123);
  EXPECT_EQ(value_of(r->events()).size(), 4U);
  (void)raw_of(*r);
  EXPECT_EQ(value_of(r->state()),
            StateBytes().add(uint32_t{1}).add(uint32_t{3}).add(newest(events, 3)).bytes());
}

TEST(Aae, KeepLeavesTheQueues) {
  const auto events = steady(5, 1'000);
  const auto r = reference(AaeParameters{.keep = true}, kRow, events);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(raw_of(*r), ElementsAre(0, 1, 1, 1, 1, 0));
    EXPECT_THAT(u8_of(*r), ElementsAre(0, 102, 102, 102, 102, 0));
    EXPECT_EQ(value_of(r->events()), events);
  }
  EXPECT_THAT(raw_of(*reference(AaeParameters{.keep = true}, kRow, {event(0, 1)})), Each(0));
}

TEST(Aae, EventsOutsideAreDropped) {
  const auto r = aae({event(0, 0), event(1, 6), event(2, 0, 1), event(3, 1)});
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{event(0, 0), event(3, 1)}));
}

TEST(Aae, ParametersBelongToTheInstance) {
  const auto events = steady(6, 1'000);
  const auto one = reference(AaeParameters{.block = 3}, kRow, events);
  const auto two = reference(AaeParameters{.block = 15, .keep = true}, kRow, events);
  EXPECT_THAT(raw_of(*one), ElementsAre(0, 1, 1, 0, 1, 1));
  EXPECT_THAT(raw_of(*two), ElementsAre(0, 1, 1, 1, 1, 1));
  EXPECT_THAT(raw_of(*one), ElementsAre(0, 0, 1, 0, 0, 1));
  EXPECT_THAT(raw_of(*two), ElementsAre(0, 1, 1, 1, 1, 1));
}

// ESVO2's variant, by the sums of events so many seconds apart: with steps of 1 s A tends to 1.618 = 1.618
// / 2.618 + 1, with steps of 0 it grows by 1.
std::unique_ptr<Representation> esvo2(const std::vector<Event>& events, SensorSize sensor = {8, 6},
                                      bool keep = false) {
  return reference(AaeParameters{.keep = keep, .esvo2 = true}, sensor, events);
}

int64_t draws(Representation& r) {
  return raw_of(r)[0];
}

TEST(AaeEsvo2, TheWalkStopsAtTheTwentiethEvent) {
  const auto events = [](size_t count) {
    std::vector<Event> out;
    for (size_t i = 0; i < count; ++i) out.push_back(event(static_cast<int64_t>(i) * 1'000'000, 0));
    return out;
  };
  // Both A are 1.618 after ten events, and |A - A_f| = 0; but the check after ten is left out.
  EXPECT_EQ(draws(*esvo2(events(1))), 1);
  EXPECT_EQ(draws(*esvo2(events(9))), 9);
  EXPECT_EQ(draws(*esvo2(events(19))), 19);
  EXPECT_EQ(draws(*esvo2(events(20))), 20);
  EXPECT_EQ(draws(*esvo2(events(35))), 20);
}

TEST(AaeEsvo2, TheWalkGoesOnWhileTheActivityDiffers) {
  // 24 events in steps of 1 s, then 9 more at once: A_f = 1.618 + 9 = 10.618. Back: A = 10 after ten events,
  // 0.618 off, where no check is; then 1.909, ... 1.618 after twenty and thirty, 9 off. All 33 are drawn.
  std::vector<Event> events;
  for (int64_t i = 0; i < 24; ++i) events.push_back(event(i * 1'000'000, 0));
  for (int64_t i = 0; i < 9; ++i) events.push_back(event(23'000'000, 0));
  EXPECT_EQ(draws(*esvo2(events)), 33);
  // The other way round: A_f = 1.618. Back: 1.618 after twenty; stop.
  std::vector<Event> slow_at_last(9, event(-1'000'000, 0));
  slow_at_last.insert(slow_at_last.end(), events.begin(), events.begin() + 24);
  EXPECT_EQ(draws(*esvo2(slow_at_last)), 20);
  // Steps back count by their length, |dt|: 35 events in steps of -1 s are as 35 of 1 s.
  std::vector<Event> backwards;
  for (int64_t i = 0; i < 35; ++i) backwards.push_back(event(-i * 1'000'000, 0));
  EXPECT_EQ(draws(*esvo2(backwards)), 20);
}

TEST(AaeEsvo2, AQueryEmptiesTheQueues) {
  std::vector<Event> events(3, event(0, 0));
  const auto r = esvo2(events);
  EXPECT_EQ(value_of(r->events()), events);
  EXPECT_EQ(draws(*r), 3);
  EXPECT_THAT(value_of(r->events()), IsEmpty());
  EXPECT_EQ(draws(*r), 0);
  ASSERT_TRUE(r->push(std::vector<Event>{event(1, 0)}));
  EXPECT_EQ(float_of(*r)[0], 0.4F);
  EXPECT_EQ(u8_of(*r)[0], 0);
  const auto kept = esvo2(events, {8, 6}, /*keep=*/true);
  EXPECT_EQ(draws(*kept), 3);
  EXPECT_EQ(draws(*kept), 3);
  EXPECT_EQ(value_of(kept->events()), events);
}

TEST(AaeEsvo2, EightBySixBlocks) {
  // 17x13: blocks of 3x3 pixels, 8 of which would cover 24 columns and 6 of which 18 rows.
  const Event a = event(0, 2, 2);
  const Event b = event(0, 3, 2);
  const Event c = event(0, 2, 3);
  const Event d = event(0, 16, 12);
  const auto r = esvo2({d, c, b, a, d, c, b, a}, {17, 13});
  EXPECT_EQ(value_of(r->events()), (std::vector<Event>{a, a, b, b, c, c, d, d}));
  StateBytes expected;
  expected.add(uint32_t{48});
  for (int block = 0; block < 48; ++block) {
    // Columns of blocks are 0, 1, 5; rows 0, 1, 4.
    const std::vector<Event> queue = block == 0           ? std::vector<Event>{a, a}
                                     : block == 1         ? std::vector<Event>{b, b}
                                     : block == 8         ? std::vector<Event>{c, c}
                                     : block == 4 * 8 + 5 ? std::vector<Event>{d, d}
                                                          : std::vector<Event>{};
    expected.add(static_cast<uint32_t>(queue.size())).add(queue);
  }
  EXPECT_EQ(value_of(r->state()), expected.bytes());
}

}  // namespace
}  // namespace scarf::test
