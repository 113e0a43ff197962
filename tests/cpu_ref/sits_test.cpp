// SITS, its three rules worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Rule = SitsParameters::Rule;

constexpr SensorSize kRow = {5, 1};
constexpr SensorSize kSquare = {3, 3};

std::unique_ptr<Representation> sits(Rule rule, int32_t kernel, SensorSize sensor,
                                     const std::vector<Event>& events = {}) {
  return reference(SitsParameters{.rule = rule, .kernel = kernel}, sensor, events);
}

// The raw row of kRow after one event more.
std::vector<int64_t> after(Representation& r, int32_t x) {
  EXPECT_TRUE(r.push(std::vector<Event>{event(0, x)}).ok());
  return raw_of(r);
}

TEST(Sits, BeforeAnyEvent) {
  for (Rule rule : {Rule::paper, Rule::greater, Rule::event_driven}) {
    const auto r = sits(rule, 9, kRow);
    EXPECT_THAT(u8_of(*r), Each(0));
    EXPECT_THAT(float_of(*r), Each(0));
    EXPECT_THAT(raw_of(*r), Each(0));
    EXPECT_EQ(value_of(r->state()), std::vector<uint8_t>(20));
  }
}

TEST(Sits, PaperByHand) {
  const auto r = sits(Rule::paper, 3, kRow);
  // c = 0: the neighbours, 0 as well, go below it.
  EXPECT_THAT(after(*r, 2), ElementsAre(0, -1, 9, -1, 0));
  // c = -1: 9 becomes 8, and 0 becomes -1.
  EXPECT_THAT(after(*r, 3), ElementsAre(0, -1, 8, 9, -1));
  // c = 8: only the 9.
  EXPECT_THAT(after(*r, 2), ElementsAre(0, -1, 9, 8, -1));
  // c = 9: nothing is as large.
  EXPECT_THAT(after(*r, 2), ElementsAre(0, -1, 9, 8, -1));
  EXPECT_THAT(after(*r, 3), ElementsAre(0, -1, 8, 9, -1));
  EXPECT_THAT(after(*r, 0), ElementsAre(9, -1, 8, 9, -1));
  EXPECT_THAT(after(*r, 1), ElementsAre(8, 9, 7, 9, -1));
  EXPECT_THAT(after(*r, 2), ElementsAre(8, 8, 9, 8, -1));
  // c = 8: the equal neighbour is taken along.
  EXPECT_THAT(after(*r, 0), ElementsAre(9, 7, 9, 8, -1));
  // 255 * 7 / 9 = 198.3 and 255 * 8 / 9 = 226.7; negative values are shown as 0.
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 198, 255, 227, 0));
  EXPECT_THAT(float_of(*r), ElementsAre(1, static_cast<float>(7.0 / 9), 1, static_cast<float>(8.0 / 9), 0));
  EXPECT_EQ(value_of(r->state()), StateBytes().add(std::vector<int32_t>{9, 7, 9, 8, -1}).bytes());
}

TEST(Sits, GreaterByHand) {
  const auto r = sits(Rule::greater, 3, kRow);
  EXPECT_THAT(after(*r, 2), ElementsAre(0, 0, 9, 0, 0));  // c = 0: nothing is larger
  EXPECT_THAT(after(*r, 3), ElementsAre(0, 0, 8, 9, 0));
  EXPECT_THAT(after(*r, 2), ElementsAre(0, 0, 9, 8, 0));
  EXPECT_THAT(after(*r, 2), ElementsAre(0, 0, 9, 8, 0));
  EXPECT_THAT(after(*r, 3), ElementsAre(0, 0, 8, 9, 0));
  EXPECT_THAT(after(*r, 0), ElementsAre(9, 0, 8, 9, 0));
  EXPECT_THAT(after(*r, 1), ElementsAre(8, 9, 7, 9, 0));
  EXPECT_THAT(after(*r, 2), ElementsAre(8, 8, 9, 8, 0));
  EXPECT_THAT(after(*r, 0), ElementsAre(9, 8, 9, 8, 0));  // c = 8: the equal neighbour stays
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 227, 255, 227, 0));
}

// The four corners, then the centre twice. Windows of 3x3, so the corners' are clipped to 2x2.
const std::vector<Event> kCornersAndCentre = {event(0, 0, 0), event(0, 2, 0), event(0, 0, 2),
                                              event(0, 2, 2), event(0, 1, 1), event(0, 1, 1)};

TEST(Sits, CornersAndCentre) {
  // Paper, c = 0 at every corner: what is still 0 in its window becomes -1. Then the centre at -1 lowers all,
  // and the centre at 9 nothing.
  EXPECT_THAT(raw_of(*sits(Rule::paper, 3, kSquare, kCornersAndCentre)),  //
              ElementsAre(8, -2, 8,                                       //
                          -2, 9, -2,                                      //
                          8, -2, 8));
  EXPECT_THAT(raw_of(*sits(Rule::greater, 3, kSquare, kCornersAndCentre)),  //
              ElementsAre(8, 0, 8,                                          //
                          0, 9, 0,                                          //
                          8, 0, 8));
}

TEST(SitsEventDriven, TheCentreIsComparedWithByReference) {
  // Column by column: the centre itself is >= c, so it falls by one, and later pixels meet c - 1.
  //   corner (0,0), visited first, c = 0 -> -1:   9 -1  0   -1 -1  0    0  0  0
  //   corner (2,0), after its left neighbours:    9 -1  9   -1 -1 -1    0  0  0
  //   corner (0,2), before (1,1) and (1,2):       9 -1  9   -1 -2 -1    9 -1  0   (1,1) >= -1
  //   corner (2,2), last:                         9 -1  9   -1 -2 -1    9 -1  9
  std::vector<Event> events(kCornersAndCentre.begin(), kCornersAndCentre.begin() + 4);
  EXPECT_THAT(raw_of(*sits(Rule::event_driven, 3, kSquare, events)),  //
              ElementsAre(9, -1, 9,                                   //
                          -1, -2, -1,                                 //
                          9, -1, 9));
  // The centre at -2 lowers all.
  events.push_back(event(0, 1, 1));
  EXPECT_THAT(raw_of(*sits(Rule::event_driven, 3, kSquare, events)),  //
              ElementsAre(8, -2, 8,                                   //
                          -2, 9, -2,                                  //
                          8, -2, 8));
  // The centre at 9: the 8s of the first column are less, those of the last column, after the centre, are as
  // large as 8.
  const auto r = sits(Rule::event_driven, 3, kSquare, kCornersAndCentre);
  EXPECT_THAT(raw_of(*r),             //
              ElementsAre(8, -2, 7,   //
                          -2, 9, -2,  //
                          8, -2, 7));
  // The bytes are the values as they are.
  EXPECT_THAT(u8_of(*r),            //
              ElementsAre(8, 0, 7,  //
                          0, 9, 0,  //
                          8, 0, 7));
  const auto eight = static_cast<float>(8.0 / 9);
  const auto seven = static_cast<float>(7.0 / 9);
  EXPECT_THAT(float_of(*r), ElementsAre(eight, 0, seven, 0, 1, 0, eight, 0, seven));
}

TEST(SitsEventDriven, RowsWithinAColumn) {
  // One column of three. First y = 1, then 0, then 2, then 1 twice; k = 3.
  //   y=1: c = 0:                     -1  9 -1
  //   y=0: c = -1, itself first:       9  8 -1
  //   y=2: c = -1, itself last:        9  7  9
  //   y=1: c = 7, all:                 8  9  8
  //   y=1: c = 9: above no, itself, below as large as 8.
  const auto r = sits(Rule::event_driven, 3, {1, 3},
                      {event(0, 0, 1), event(0, 0, 0), event(0, 0, 2), event(0, 0, 1), event(0, 0, 1)});
  EXPECT_THAT(raw_of(*r), ElementsAre(8, 9, 7));
}

TEST(SitsEventDriven, BytesAreClipped) {
  EXPECT_THAT(u8_of(*sits(Rule::event_driven, 15, {1, 1}, {event(0, 0)})), ElementsAre(225));
  const auto r = sits(Rule::event_driven, 17, {1, 1}, {event(0, 0)});
  EXPECT_THAT(raw_of(*r), ElementsAre(289));
  EXPECT_THAT(u8_of(*r), ElementsAre(255));
  EXPECT_THAT(float_of(*r), ElementsAre(1));
}

TEST(Sits, NineByNineByDefault) {
  const auto r = reference(SitsParameters{}, {10, 1}, {event(0, 0), event(0, 4), event(0, 5)});
  // Reach 4. Pixel 0 lowers 1..4 to -1; 4 (c = -1) lowers all of 0..8; 5 (c = -1) lowers 1..9 where >= -1.
  EXPECT_THAT(raw_of(*r), ElementsAre(80, -2, -2, -2, 80, 81, -2, -2, -2, -1));
  EXPECT_EQ(u8_of(*r)[0], 252);  // 255 * 80 / 81 = 251.85
  EXPECT_EQ(u8_of(*r)[5], 255);
}

TEST(Sits, WindowsAreClippedAtTheSensor) {
  // (3,0) of 4x3 with 3x3 windows touches neither the row below's first pixel nor its own row's.
  EXPECT_THAT(raw_of(*sits(Rule::paper, 3, {4, 3}, {event(0, 3, 0)})),  //
              ElementsAre(0, 0, -1, 9,                                  //
                          0, 0, -1, -1,                                 //
                          0, 0, 0, 0));
}

TEST(Sits, EvenKernelsAreRaised) {
  const SensorSize sensor = {14, 11};
  const auto events = make_stream(Spread::uniform, sensor, 600, 5);
  for (Rule rule : {Rule::paper, Rule::greater, Rule::event_driven}) {
    const auto even = sits(rule, 4, sensor, events);
    const auto odd = sits(rule, 5, sensor, events);
    EXPECT_EQ(value_of(even->state()), value_of(odd->state()));
    EXPECT_EQ(u8_of(*even), u8_of(*odd));
  }
}

// The rules of the definition, one event.
void sequential(Rule rule, int32_t reach, SensorSize sensor, std::vector<int64_t>& values, const Event& e) {
  const auto at = [&](int32_t x, int32_t y) -> int64_t& {
    return values[static_cast<size_t>(y) * sensor.width + x];
  };
  int64_t& centre = at(e.x, e.y);
  const int64_t before = centre;
  for (int32_t x = 0; x < sensor.width; ++x) {
    for (int32_t y = 0; y < sensor.height; ++y) {
      if (std::abs(x - e.x) > reach || std::abs(y - e.y) > reach) continue;
      const int64_t c = rule == Rule::event_driven ? centre : before;
      if (rule == Rule::greater ? at(x, y) > c : at(x, y) >= c) --at(x, y);
    }
  }
  centre = int64_t{2 * reach + 1} * (2 * reach + 1);
}

TEST(Sits, EqualsTheSequentialRule) {
  const SensorSize sensor = {23, 17};
  for (Rule rule : {Rule::paper, Rule::greater, Rule::event_driven}) {
    for (int32_t k = 3; k <= 13; k += 2) {
      for (Spread spread : {Spread::uniform, Spread::moving_edge, Spread::corners, Spread::border}) {
        std::vector<int64_t> expected(23 * 17);
        const auto events = make_stream(spread, sensor, 1'000, static_cast<uint64_t>(k));
        for (const Event& e : events) sequential(rule, k / 2, sensor, expected, e);
        ASSERT_EQ(raw_of(*sits(rule, k, sensor, events)), expected)
            << "rule " << static_cast<int>(rule) << " k " << k << " spread " << static_cast<int>(spread);
      }
    }
  }
}

TEST(Sits, GreaterIsNeverNegative) {
  const SensorSize sensor = {15, 12};
  const auto r = sits(Rule::greater, 5, sensor, make_stream(Spread::uniform, sensor, 5'000, 11));
  EXPECT_THAT(raw_of(*r), Each(testing::AllOf(testing::Ge(0), testing::Le(25))));
}

TEST(Sits, ParametersBelongToTheInstance) {
  const auto three = sits(Rule::paper, 3, kRow, {event(0, 2)});
  const auto five = sits(Rule::paper, 5, kRow, {event(0, 2)});
  const auto greater = sits(Rule::greater, 5, kRow, {event(0, 2)});
  EXPECT_THAT(raw_of(*three), ElementsAre(0, -1, 9, -1, 0));
  EXPECT_THAT(raw_of(*five), ElementsAre(-1, -1, 25, -1, -1));
  EXPECT_THAT(raw_of(*greater), ElementsAre(0, 0, 25, 0, 0));
}

TEST(Sits, KeepsNoEvents) {
  const auto events = reference(SitsParameters{}, kRow)->events().wait();
  ASSERT_FALSE(events.ok());
  EXPECT_THAT(events.error().message, HasSubstr("aae"));
}

}  // namespace
}  // namespace scarf::test
