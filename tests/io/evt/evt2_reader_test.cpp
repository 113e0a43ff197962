#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr uint32_t high(uint32_t value) {
  return 0x80000000u | value;
}
constexpr uint32_t off(uint32_t t, uint32_t x, uint32_t y) {
  return t << 22 | x << 11 | y;
}
constexpr uint32_t on(uint32_t t, uint32_t x, uint32_t y) {
  return 0x10000000u | off(t, x, y);
}

TEST(Evt2Reader, DecodesFieldsByBit) {
  // 0x1: ON, ts 0b100001 = 33, x 0b10000000001 = 1025, y 0b11111111111 = 2047.
  const auto r = read_all(evt2_file({0x80000001u, 0b0001'100001'10000000001'11111111111u, 0x00000000u}));
  EXPECT_EQ(r.format, "evt2");
  EXPECT_EQ(r.sensor, std::nullopt);
  EXPECT_THAT(r.events, ElementsAre(Event{64 + 33, 1025, 2047, 1}, Event{64, 0, 0, 0}));
}

TEST(Evt2Reader, IgnoresEverythingBeforeTheFirstTimeHigh) {
  const auto r = read_all(evt2_file({on(1, 2, 3), 0x50000000u, high(2), off(1, 2, 3)}));
  EXPECT_THAT(r.events, ElementsAre(Event{129, 2, 3, 0}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(Evt2Reader, SkipsTriggersImuAndOthersAndCountsReservedWords) {
  const auto r = read_all(evt2_file({high(0), 0xA0000101u, 0xE0000014u, 0xF0000001u,
                                     // an IMU block: its words are no events whatever they look like
                                     0xD0000000u, on(0, 9, 9), on(0, 9, 9), high(77), 0x20000000u,
                                     on(0, 9, 9), 0x20000000u, 0xC0000000u, on(5, 1, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{5, 1, 1, 1}));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Evt2Reader, WrapsWhenTimeHighFallsByHalfItsRange) {
  const auto r = read_all(evt2_file(
      {high(0x0FFFFFFF), on(63, 1, 1), high(0), on(0, 1, 1), high(0x08000000), high(0), on(1, 1, 1)}));
  const int64_t loop = int64_t{1} << 34;
  EXPECT_THAT(r.events,
              ElementsAre(Event{loop - 1, 1, 1, 1}, Event{loop, 1, 1, 1}, Event{2 * loop + 1, 1, 1, 1}));
  EXPECT_EQ(r.report.back_steps, 0u);
}

TEST(Evt2Reader, TakesASmallerFallAsABackStep) {
  const auto r = read_all(evt2_file(
      {high(0x08000000), on(0, 1, 1), high(1), on(0, 1, 1), high(0x08000000), on(9, 1, 1), on(7, 1, 1)}));
  const int64_t half = int64_t{1} << 33;
  EXPECT_THAT(r.events, ElementsAre(Event{half, 1, 1, 1}, Event{64, 1, 1, 1}, Event{half + 9, 1, 1, 1},
                                    Event{half + 7, 1, 1, 1}));
  EXPECT_EQ(r.report.back_steps, 2u);
  EXPECT_EQ(r.report.largest_back_step, half - 64);
}

TEST(Evt2Reader, DropsEventsOutsideTheSensorAndCountsTheirBackSteps) {
  const auto r = read_all(evt2_file({high(0), on(9, 639, 479), on(8, 640, 0), on(8, 0, 480), on(8, 0, 0)},
                                    "% geometry 640x480\n"));
  EXPECT_THAT(r.events, ElementsAre(Event{9, 639, 479, 1}, Event{8, 0, 0, 1}));
  EXPECT_EQ(r.report.events, 2u);
  EXPECT_EQ(r.report.outside, 2u);
  EXPECT_EQ(r.report.back_steps, 1u);
  EXPECT_EQ(r.report.largest_back_step, 1);
}

TEST(Evt2Reader, ReportsThePartialWordAtTheEnd) {
  for (size_t cut = 1; cut < 4; ++cut) {
    Bytes bytes = evt2_file({high(0), on(1, 1, 1), on(2, 2, 2)});
    bytes.resize(bytes.size() - cut);
    const auto r = read_all(bytes);
    EXPECT_EQ(r.events.size(), 1u);
    EXPECT_EQ(r.report.truncated_bytes, 4 - cut);
  }
}

TEST(Evt2Reader, IsRecognisedWithoutAHeader) {
  Bytes bytes;
  for (uint32_t i = 0; i < 100; ++i) {
    for (const uint32_t word : {high(1000 + i), on(i & 63, 15 * i & 511, i)}) {
      for (int b = 0; b < 4; ++b) bytes.push_back(static_cast<uint8_t>(word >> (8 * b)));
    }
  }
  const auto r = read_all(bytes);
  EXPECT_EQ(r.format, "evt2") << r.error;
  EXPECT_EQ(r.events.size(), 100u);
  EXPECT_EQ(r.sensor, std::nullopt);
}

TEST(Evt2Reader, AnEmptyRecordingHasNoEvents) {
  const auto r = read_all(evt2_file({}));
  EXPECT_THAT(r.events, IsEmpty());
  EXPECT_EQ(r.error, "");
}

}  // namespace
}  // namespace scarf
