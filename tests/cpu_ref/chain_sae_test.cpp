// CHAIN-SAE, worked out by hand: pixels by the order in which they last fired.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Rule = ChainSaeParameters::Rule;

constexpr SensorSize kRow = {4, 1};

TEST(ChainSae, BeforeAnyEvent) {
  const auto r = reference(ChainSaeParameters{}, kRow);
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(float_of(*r), Each(0));
  EXPECT_THAT(raw_of(*r), Each(-1));
  EXPECT_EQ(value_of(r->state()), std::vector<uint8_t>(4));
}

TEST(ChainSae, TenthPowerOfTheRank) {
  // Ranks 2, 1, 0 of four pixels: 0.5^10 = 0.00098, 0.75^10 = 0.0563, 1; times 255: 0.2, 14.4, 255.
  const auto r = reference(ChainSaeParameters{}, kRow, {event(1, 2), event(2, 0), event(3, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(1, 0, 2, -1));
  EXPECT_THAT(u8_of(*r), ElementsAre(14, 255, 0, 0));
  EXPECT_THAT(float_of(*r), ElementsAre(static_cast<float>(std::pow(0.75, 10)), 1,
                                        static_cast<float>(std::pow(0.5, 10)), 0));
  EXPECT_EQ(value_of(r->state()), StateBytes().add(std::vector<uint32_t>{3, 1, 0, 2}).bytes());
}

TEST(ChainSae, LinearRank) {
  // 255 * 0.75 = 191.25; 255 * 0.5 = 127.5, half to even; 255 * 0.25 = 63.75.
  const auto r = reference(ChainSaeParameters{.linear = true}, kRow,
                           {event(1, 3), event(2, 2), event(3, 0), event(4, 1)});
  EXPECT_THAT(u8_of(*r), ElementsAre(191, 255, 128, 64));
  EXPECT_THAT(float_of(*r), ElementsAre(0.75F, 1, 0.5F, 0.25F));
}

TEST(ChainSae, AnEventMovesItsPixelToTheNewestPlace) {
  auto r = reference(ChainSaeParameters{}, kRow, {event(1, 0), event(2, 1), event(3, 2), event(4, 0, 0, 0)});
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 2, 1, -1));
  ASSERT_TRUE(r->push(std::vector<Event>{event(5, 0), event(6, 2), event(7, 2)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(1, 2, 0, -1));
}

TEST(ChainSae, ArrivalCountsNotTime) {
  // Equal times, and times that run backwards.
  const auto r = reference(ChainSaeParameters{}, kRow, {event(7, 3), event(7, 1), event(7, 2), event(-9, 0)});
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 2, 1, 3));
}

TEST(ChainSae, PixelsThatNeverFiredTakeNoRank) {
  // 6 pixels: the weights are those of 6 ranks, though only two pixels fired.
  const auto r = reference(ChainSaeParameters{.linear = true}, {3, 2}, {event(1, 2, 0), event(2, 0, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(-1, -1, 1, 0, -1, -1));
  EXPECT_THAT(float_of(*r), ElementsAre(0, 0, static_cast<float>(1 - 1.0 / 6), 1, 0, 0));
}

TEST(ChainSae, EventsOutsideAreDropped) {
  const auto r = reference(ChainSaeParameters{}, kRow, {event(1, 1), event(2, 4), event(3, 0, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(-1, 0, -1, -1));
}

TEST(ChainSae, RankIsTheNumberOfPixelsThatFiredSince) {
  const SensorSize sensor = {19, 13};
  for (Spread spread : kSpreads) {
    const auto events = make_stream(spread, sensor, 800, 17);
    std::vector<int64_t> last(19 * 13, -1);
    for (size_t i = 0; i < events.size(); ++i) {
      if (sensor.contains(events[i])) last[events[i].y * 19 + events[i].x] = static_cast<int64_t>(i);
    }
    const auto r = reference(ChainSaeParameters{}, sensor, events);
    const auto raw = raw_of(*r);
    const auto levels = float_of(*r);
    for (size_t p = 0; p < last.size(); ++p) {
      const int64_t rank =
          last[p] < 0 ? -1 : std::count_if(last.begin(), last.end(), [&](int64_t l) { return l > last[p]; });
      ASSERT_EQ(raw[p], rank);
      ASSERT_EQ(levels[p],
                rank < 0 ? 0 : static_cast<float>(std::pow(1 - static_cast<double>(rank) / 247, 10)));
    }
  }
}

// Linear weights of four pixels are 255, 191, 128, 64 for the ranks 0 to 3. All pixels are in the list from
// the start, pixel 0 oldest. The oldest pixel is not written, and pixel 3 is written to pixel 0.
std::unique_ptr<Representation> event_driven(const std::vector<Event>& events, SensorSize sensor = kRow) {
  return reference(ChainSaeParameters{.rule = Rule::event_driven, .linear = true}, sensor, events);
}

TEST(ChainSaeEventDriven, AllPixelsAreInTheListFromTheStart) {
  // From newest to oldest 3, 2, 1, 0: pixel 3's rank 0 goes to pixel 0, and pixel 0 as the oldest keeps it.
  const auto seen = u8_of(*event_driven({}));
  EXPECT_EQ(seen[0], 255);
  EXPECT_EQ(seen[1], 128);
  EXPECT_EQ(seen[2], 191);
  EXPECT_EQ(seen[3], 0);  // never written
}

TEST(ChainSaeEventDriven, Raw) {
  // Newest to oldest 2, 3, 1, 0.
  auto r = event_driven({event(0, 2)});
  EXPECT_EQ(value_of(r->state()), StateBytes()
                                      .add(std::vector<uint32_t>{2, 3, 1, 0})
                                      .add(std::vector<int32_t>{4, 4, 0, 4})  // cells before the query
                                      .bytes());
  EXPECT_THAT(raw_of(*r), ElementsAre(1, 2, 0, -1));
  EXPECT_EQ(
      value_of(r->state()),
      StateBytes().add(std::vector<uint32_t>{2, 3, 1, 0}).add(std::vector<int32_t>{1, 2, 0, 4}).bytes());
}

TEST(ChainSaeEventDriven, TheTenthPowerIsTheDefault) {
  const auto r = reference(ChainSaeParameters{.rule = Rule::event_driven}, kRow);
  EXPECT_EQ(u8_of(*r)[2], 14);
}

TEST(ChainSaeEventDriven, EventsMovePixelsToTheNewestPlace) {
  // Newest to oldest: 1, 3, 2, 0. Pixel 3's rank 1 goes to pixel 0, which is skipped.
  const auto seen = u8_of(*event_driven({event(0, 1)}));
  EXPECT_EQ(seen[0], 191);
  EXPECT_EQ(seen[1], 255);
  EXPECT_EQ(seen[2], 128);
}

TEST(ChainSaeEventDriven, LaterWritesToTheSharedCellWin) {
  // Newest to oldest 2, 3, 0, 1: pixel 3 writes rank 1 to the cell of pixel 0, then pixel 0 writes rank 2.
  // Pixel 1 is the oldest, and keeps what it never had.
  const auto pixel_0_older = u8_of(*event_driven({event(0, 0), event(1, 3), event(2, 2)}));
  EXPECT_EQ(pixel_0_older[0], 128);
  EXPECT_EQ(pixel_0_older[1], 0);
  EXPECT_EQ(pixel_0_older[2], 255);
  // 2, 0, 3, 1: the other way round, pixel 3 writes last.
  const auto pixel_3_older = u8_of(*event_driven({event(0, 3), event(1, 0), event(2, 2)}));
  EXPECT_EQ(pixel_3_older[0], 128);
}

TEST(ChainSaeEventDriven, TheOldestPixelKeepsItsCell) {
  auto r = event_driven({});
  EXPECT_EQ(u8_of(*r)[1], 128);  // written at rank 2
  // Newest to oldest 3, 2, 0, 1: pixel 1 keeps 128 instead of 64.
  ASSERT_TRUE(r->push(std::vector<Event>{event(0, 0), event(0, 2), event(0, 3)}));
  const auto seen = u8_of(*r);
  EXPECT_EQ(seen[0], 128);  // rank 2, written after pixel 3's rank 0
  EXPECT_EQ(seen[1], 128);
  EXPECT_EQ(seen[2], 191);
  // Without the query before, pixel 1 had never been written.
  EXPECT_EQ(u8_of(*event_driven({event(0, 0), event(0, 2), event(0, 3)}))[1], 0);
}

TEST(ChainSaeEventDriven, AnEventBrightensItsCell) {
  // Pixel 1 fires first, so its cell is 1; then the others: 0, 2, 3. It is the oldest and keeps the 1.
  const auto seen = u8_of(*event_driven({event(0, 1), event(0, 0), event(0, 2), event(0, 3)}));
  EXPECT_EQ(seen[0], 128);
  EXPECT_EQ(seen[1], 255);
  EXPECT_EQ(seen[2], 191);
}

TEST(ChainSaeEventDriven, OnePixel) {
  const auto r = event_driven({}, {1, 1});
  EXPECT_THAT(u8_of(*r), ElementsAre(0));  // the oldest, never written
  ASSERT_TRUE(r->push(std::vector<Event>{event(0, 0)}));
  EXPECT_THAT(u8_of(*r), ElementsAre(255));
}

TEST(ChainSaeEventDriven, EventsOutsideAreDropped) {
  const auto r = event_driven({event(0, 4), event(0, 0, 1)});
  EXPECT_EQ(value_of(r->state()), value_of(event_driven({})->state()));
}

TEST(ChainSae, ParametersBelongToTheInstance) {
  const std::vector<Event> events = {event(1, 2), event(2, 0)};
  const auto linear = reference(ChainSaeParameters{.linear = true}, kRow, events);
  const auto power = reference(ChainSaeParameters{}, kRow, events);
  EXPECT_EQ(u8_of(*linear)[2], 191);
  EXPECT_EQ(u8_of(*power)[2], 14);
  EXPECT_EQ(u8_of(*linear)[2], 191);
}

TEST(ChainSae, KeepsNoEvents) {
  for (Rule rule : {Rule::paper, Rule::event_driven}) {
    const auto events = reference(ChainSaeParameters{.rule = rule}, kRow)->events().wait();
    ASSERT_FALSE(events.ok());
    EXPECT_THAT(events.error().message, HasSubstr("aae"));
  }
}

}  // namespace
}  // namespace scarf::test
