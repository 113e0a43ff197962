#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr uint16_t addr_y(unsigned y) {
  return static_cast<uint16_t>(y);
}
constexpr uint16_t addr_x(unsigned x, unsigned p) {
  return static_cast<uint16_t>(0x2000 | p << 11 | x);
}
constexpr uint16_t base_x(unsigned x, unsigned p) {
  return static_cast<uint16_t>(0x3000 | p << 11 | x);
}
constexpr uint16_t vect12(unsigned mask) {
  return static_cast<uint16_t>(0x4000 | mask);
}
constexpr uint16_t vect8(unsigned mask) {
  return static_cast<uint16_t>(0x5000 | mask);
}
constexpr uint16_t low(unsigned t) {
  return static_cast<uint16_t>(0x6000 | t);
}
constexpr uint16_t high(unsigned t) {
  return static_cast<uint16_t>(0x8000 | t);
}

TEST(Evt3Reader, DecodesFieldsByBit) {
  // Row 0x7FF with the camera bit 11 set; x 0x401 ON, then x 2 OFF.
  const auto r = read_all(evt3_file({0x8002, 0x6003, 0x0FFF, 0x2C01, 0x2002}));
  EXPECT_EQ(r.format, "evt3");
  EXPECT_THAT(r.events, ElementsAre(Event{2 * 4096 + 3, 1025, 2047, 1}, Event{2 * 4096 + 3, 2, 2047, 0}));
}

TEST(Evt3Reader, IgnoresEverythingBeforeTheFirstTimeHigh) {
  const auto r = read_all(evt3_file(
      {addr_y(7), low(9), base_x(3, 1), 0xB000, addr_x(1, 1), vect8(1), high(1), addr_x(1, 1), vect8(1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{4096, 1, 0, 1}, Event{4096, 0, 0, 0}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(Evt3Reader, VectorsCountOnFromTheirBase) {
  const auto r =
      read_all(evt3_file({high(0), low(5), addr_y(3), base_x(100, 1), vect12(0x801), vect12(0), vect8(0x81),
                          addr_x(7, 0), vect12(2), base_x(50, 0), vect8(0xFFF & 0x82)}));
  EXPECT_THAT(r.events,
              ElementsAre(Event{5, 100, 3, 1}, Event{5, 111, 3, 1}, Event{5, 124, 3, 1}, Event{5, 131, 3, 1},
                          Event{5, 7, 3, 0}, Event{5, 133, 3, 1}, Event{5, 51, 3, 0}, Event{5, 57, 3, 0}));
}

TEST(Evt3Reader, TheUpperBitsOfAVect8AreNoEvents) {
  const auto r = read_all(evt3_file({high(0), base_x(0, 1), 0x5F00}));
  EXPECT_THAT(r.events, IsEmpty());
  EXPECT_EQ(r.error, "");
}

TEST(Evt3Reader, ChecksEachEventOfAVectorAgainstTheSensorEdge) {
  const auto r =
      read_all(evt3_file({high(0), base_x(630, 1), vect12(0xFFF), vect12(0xFFF)}, "% geometry 640x480\n"));
  ASSERT_EQ(r.events.size(), 10u);
  EXPECT_EQ(r.events.back(), (Event{0, 639, 0, 1}));
  EXPECT_EQ(r.report.outside, 14u);
}

TEST(Evt3Reader, ABaseThatRunsAwayNeverComesBackIntoTheSensor) {
  Bytes bytes = evt3_file({high(0), base_x(2047, 1)}, "% geometry 1280x720\n");
  for (int i = 0; i < 20'000; ++i) {
    bytes.push_back(0xFF);
    bytes.push_back(0x4F);
  }
  const auto r = read_all(bytes);
  EXPECT_THAT(r.events, IsEmpty());
  EXPECT_EQ(r.report.outside, 20'000u * 12);
}

TEST(Evt3Reader, ANewTimeHighSetsTimeLowToZeroAndARepeatedOneDoesNot) {
  const auto r = read_all(evt3_file(
      {high(1), low(9), addr_x(0, 0), high(1), addr_x(1, 0), high(2), addr_x(2, 0), low(4), addr_x(3, 0)}));
  EXPECT_THAT(r.events, ElementsAre(Event{4105, 0, 0, 0}, Event{4105, 1, 0, 0}, Event{8192, 2, 0, 0},
                                    Event{8196, 3, 0, 0}));
}

TEST(Evt3Reader, WrapsWhenTimeHighFallsByHalfItsRange) {
  const auto r = read_all(evt3_file(
      {high(4095), low(4095), addr_x(0, 0), high(0), addr_x(1, 0), high(2048), high(0), addr_x(2, 0)}));
  const int64_t loop = int64_t{1} << 24;
  EXPECT_THAT(r.events,
              ElementsAre(Event{loop - 1, 0, 0, 0}, Event{loop, 1, 0, 0}, Event{2 * loop, 2, 0, 0}));
}

TEST(Evt3Reader, TakesASmallerFallAsAGlitch) {
  const auto r =
      read_all(evt3_file({high(2047), addr_x(0, 0), high(0), addr_x(1, 0), high(2047), addr_x(2, 0)}));
  EXPECT_THAT(r.events,
              ElementsAre(Event{2047 * 4096, 0, 0, 0}, Event{0, 1, 0, 0}, Event{2047 * 4096, 2, 0, 0}));
  EXPECT_EQ(r.report.back_steps, 1u);
  EXPECT_EQ(r.report.largest_back_step, 2047 * 4096);
}

TEST(Evt3Reader, ATimeLowThatFallsIsABackStep) {
  const auto r = read_all(evt3_file({high(0), low(9), addr_x(0, 0), low(5), addr_x(1, 0)}));
  EXPECT_THAT(r.events, ElementsAre(Event{9, 0, 0, 0}, Event{5, 1, 0, 0}));
  EXPECT_EQ(r.report.largest_back_step, 4);
}

TEST(Evt3Reader, EventsOfOtherRowsAreNone) {
  const auto r = read_all(evt3_file(
      {high(0), base_x(0, 1), 0x1005, addr_x(1, 1), vect12(1), addr_y(2), vect12(1), addr_x(3, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{0, 12, 2, 1}, Event{0, 3, 2, 1}));
}

TEST(Evt3Reader, SkipsTriggersImuOthersAndFillersAndCountsReservedWords) {
  const auto r = read_all(evt3_file({high(0), 0xA001, 0xD123, 0xE014, 0xF001, 0xF002, 0x7003, 0x9999, 0x9998,
                                     0xB000, 0xC000, addr_x(1, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{0, 1, 0, 1}));
  EXPECT_EQ(r.report.unknown_words, 3u);
}

TEST(Evt3Reader, ReportsThePartialWordAtTheEnd) {
  Bytes bytes = evt3_file({high(0), addr_x(1, 1)});
  bytes.push_back(0x20);
  const auto r = read_all(bytes);
  EXPECT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.report.truncated_bytes, 1u);
}

TEST(Evt3Reader, IsRecognisedWithoutAHeader) {
  Bytes bytes;
  for (unsigned i = 0; i < 100; ++i) {
    for (const uint16_t word : {high(1000 + i / 50), low(i), addr_y(i), addr_x(3 * i, 1)}) {
      bytes.push_back(static_cast<uint8_t>(word));
      bytes.push_back(static_cast<uint8_t>(word >> 8));
    }
  }
  const auto r = read_all(bytes);
  EXPECT_EQ(r.format, "evt3") << r.error;
  EXPECT_EQ(r.events.size(), 100u);
}

}  // namespace
}  // namespace scarf
