#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Bytes evt4_file(std::initializer_list<uint32_t> words, std::string_view more_header = "") {
  return with_words("% evt 4.0\n" + std::string(more_header) + "% end\n", words);
}

constexpr uint32_t high(uint32_t value) {
  return 0xE0000000u | value;
}
constexpr uint32_t fields(uint32_t type, uint32_t t, uint32_t x, uint32_t y) {
  return type << 28 | t << 22 | x << 11 | y;
}

TEST(Evt4Reader, DecodesFieldsByBit) {
  const auto r = read_all(evt4_file({0xE0000001u, 0b1011'100001'10000000001'11111111111u, 0xA0000000u}));
  EXPECT_EQ(r.format, "evt4");
  EXPECT_THAT(r.events, ElementsAre(Event{97, 1025, 2047, 1}, Event{64, 0, 0, 0}));
}

TEST(Evt4Reader, AMaskFollowsTheWordOfAVector) {
  // The first mask looks like a TIME_HIGH.
  const auto r = read_all(evt4_file(
      {high(1), fields(0xD, 2, 100, 7), 0xE0000001u, fields(0xC, 3, 0, 8), 2u, fields(0xB, 4, 5, 6)}));
  EXPECT_THAT(r.events, ElementsAre(Event{66, 100, 7, 1}, Event{66, 129, 7, 1}, Event{66, 130, 7, 1},
                                    Event{66, 131, 7, 1}, Event{67, 1, 8, 0}, Event{68, 5, 6, 1}));
}

TEST(Evt4Reader, IgnoresEverythingBeforeTheFirstTimeHighMasksToo) {
  const auto r = read_all(evt4_file({fields(0xB, 1, 1, 1), 0u, fields(0xD, 2, 3, 4), 0xE0000005u,
                                     fields(0xB, 1, 1, 1), high(2), fields(0xA, 1, 2, 3)}));
  EXPECT_THAT(r.events, ElementsAre(Event{129, 2, 3, 0}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(Evt4Reader, SkipsTriggersOthersAndPaddingAndCountsReservedWords) {
  const auto r = read_all(evt4_file({high(0), 0x60000014u, 0x70000001u, 0x90000101u, 0xFFFFFFFFu, 0x00000000u,
                                     0x80000000u, fields(0xA, 5, 1, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{5, 1, 1, 0}));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Evt4Reader, ChecksEachPixelOfAMaskAgainstTheSensor) {
  const auto r = read_all(evt4_file({high(0), fields(0xD, 0, 638, 0), 7u}, "% geometry 640x480\n"));
  EXPECT_THAT(r.events, ElementsAre(Event{0, 638, 0, 1}, Event{0, 639, 0, 1}));
  EXPECT_EQ(r.report.outside, 1u);
}

TEST(Evt4Reader, WrapsWhenTimeHighFallsByHalfItsRange) {
  const int64_t loop = int64_t{1} << 34;
  const auto r =
      read_all(evt4_file({high(0x0FFFFFFF), fields(0xA, 63, 0, 0), high(0x07FFFFFF), fields(0xA, 0, 0, 0)}));
  EXPECT_THAT(r.events, ElementsAre(Event{loop - 1, 0, 0, 0}, Event{loop + (loop / 2 - 64), 0, 0, 0}));
}

TEST(Evt4Reader, AMaskThatIsMissingAtTheEndIsNoEvent) {
  const auto r = read_all(evt4_file({high(0), fields(0xD, 0, 0, 0)}));
  EXPECT_THAT(r.events, IsEmpty());
  EXPECT_EQ(r.error, "");
}

TEST(Evt4Reader, IsRecognisedWithoutAHeader) {
  Bytes bytes;
  for (uint32_t i = 0; i < 100; ++i) {
    for (const uint32_t word : {high(1000 + i), fields(0xA, i & 63, i, i), fields(0xD, i & 63, i, i), ~i}) {
      append_little_endian(bytes, word);
    }
  }
  const auto r = read_all(bytes);
  EXPECT_EQ(r.format, "evt4") << r.error;
  EXPECT_GT(r.events.size(), 200u);
}

}  // namespace
}  // namespace scarf
