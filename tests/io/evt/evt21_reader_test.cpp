#include <gmock/gmock.h>

#include <bit>

#include "core/little_endian.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kLittle = "% format EVT21;endianness=little\n% end\n";
constexpr const char* kLegacy = "% format EVT21;endianness=legacy\n% end\n";

constexpr uint64_t high(uint64_t value) {
  return 0x8ull << 60 | value << 32;
}
constexpr uint64_t row(uint64_t p, uint64_t t, uint64_t x, uint64_t y, uint64_t mask) {
  return p << 60 | t << 54 | x << 43 | y << 32 | mask;
}

Bytes little_file(const std::vector<uint64_t>& words, std::string_view header = kLittle) {
  Bytes bytes = bytes_of(header);
  for (const uint64_t word : words) append_little_endian(bytes, word);
  return bytes;
}

Bytes legacy_file(const std::vector<uint64_t>& words, std::string_view header = kLegacy) {
  Bytes bytes = bytes_of(header);
  for (const uint64_t word : words) append_little_endian(bytes, std::rotl(word, 32));
  return bytes;
}

TEST(Evt21Reader, DecodesFieldsByBit) {
  // TIME_HIGH 1; ON, ts 0b100001 = 33, x 0b10000000001 = 1025, y 0b11111111111 = 2047, pixels 0, 4 and 31.
  const uint64_t word = 0b0001'100001'10000000001'11111111111ull << 32 | 0x80000011u;
  const auto r = read_all(little_file({0x8000000100000000ull, word}));
  EXPECT_EQ(r.format, "evt21");
  EXPECT_THAT(r.events,
              ElementsAre(Event{97, 1025, 2047, 1}, Event{97, 1029, 2047, 1}, Event{97, 1056, 2047, 1}));
}

TEST(Evt21Reader, TheLegacyOrderHasTheUpperHalfFirst) {
  // TIME_HIGH 2, then OFF, ts 1, x 32, y 3, pixel 1: each half little-endian, the upper one first.
  const auto r = read_all(with_words<uint32_t>(kLegacy, {0x80000002u, 0, 0x00410003u, 0x00000002u}));
  EXPECT_THAT(r.events, ElementsAre(Event{129, 33, 3, 0}));
  EXPECT_EQ(read_all(legacy_file({high(2), row(0, 1, 32, 3, 2)})).events, r.events);
}

TEST(Evt21Reader, TheByteOrderComesFromFormatThenEndiannessThenTheCamera) {
  const auto order_of = [](const std::string& header) {
    const bool little = read_all(little_file({high(0), row(1, 0, 0, 7, 1)}, header)).events ==
                        std::vector<Event>{{0, 0, 7, 1}};
    const bool legacy = read_all(legacy_file({high(0), row(1, 0, 0, 7, 1)}, header)).events ==
                        std::vector<Event>{{0, 0, 7, 1}};
    EXPECT_NE(little, legacy) << header;
    return little ? "little" : "legacy";
  };
  const std::string prophesee = "% camera_integrator_name Prophesee\n% plugin_integrator_name Prophesee\n";
  EXPECT_STREQ(order_of("% evt 2.1\n% end\n"), "little");
  EXPECT_STREQ(order_of("% evt 2.1\n% endianness legacy\n% end\n"), "legacy");
  EXPECT_STREQ(order_of("% format EVT21;endianness=little\n% endianness legacy\n% end\n"), "little");
  EXPECT_STREQ(order_of("% evt 2.1\n% system_ID 49\n" + prophesee + "% end\n"), "legacy");
  EXPECT_STREQ(order_of("% evt 2.1\n% system_ID 55\n" + prophesee + "% end\n"), "little");
  EXPECT_STREQ(order_of("% evt 2.1\n% system_ID 49\n% integrator_name Prophesee\n% end\n"), "little");
  EXPECT_THAT(read_all(bytes_of("% evt 2.1\n% endianness big\n% end\n")).error, HasSubstr("'big'"));
}

std::vector<uint64_t> many_words() {
  std::vector<uint64_t> words;
  for (uint64_t i = 0; i < 40; ++i) {
    words.push_back(high(1000 + i));
    words.push_back(row(i % 2, i, 32 * (i % 20), i, 0xC0000003u << (i % 7)));
  }
  return words;
}

TEST(Evt21Reader, WordsThatContradictTheHeadersByteOrderAreDamageAndReadAsTheyAre) {
  const auto right = read_all(little_file(many_words()));
  EXPECT_EQ(right.report.damages, 0u);
  EXPECT_GT(right.events.size(), 90u);
  const auto wrong = read_all(little_file(many_words(), kLegacy));
  EXPECT_EQ(wrong.events, right.events);
  ASSERT_TRUE(wrong.report.damage);
  EXPECT_THAT(wrong.report.damage->what, HasSubstr("implies endianness legacy"));
  EXPECT_THAT(read_all(little_file(many_words(), kLegacy), {.sensor = std::nullopt, .strict = true}).error,
              HasSubstr("implies endianness legacy"));
  EXPECT_EQ(read_all(legacy_file(many_words(), kLittle)).events, right.events);
}

TEST(Evt21Reader, IsRecognisedWithoutAHeaderInBothByteOrders) {
  const auto right = read_all(little_file(many_words()));
  for (const Bytes& bytes : {little_file(many_words(), ""), legacy_file(many_words(), "")}) {
    const auto r = read_all(bytes);
    EXPECT_EQ(r.format, "evt21") << r.error;
    EXPECT_EQ(r.events, right.events);
  }
}

TEST(Evt21Reader, IgnoresWhatIsNoEventAndCountsUndefinedWords) {
  const auto r = read_all(
      little_file({row(1, 0, 9, 9, 1), 0x5ull << 60, high(1), 0xAull << 60 | 1, 0xEull << 60 | 0xF0000001u,
                   0xFull << 60, 0x5ull << 60, 0xDull << 60, row(0, 0, 1, 1, 0), row(0, 5, 1, 1, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{69, 1, 1, 0}));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Evt21Reader, ChecksEachPixelOfAMaskAgainstTheSensor) {
  const auto r = read_all(
      little_file({high(0), row(1, 0, 630, 0, 0xFFFFFFFF)}, "% evt 2.1\n% geometry 640x480\n% end\n"));
  EXPECT_EQ(r.events.size(), 10u);
  EXPECT_EQ(r.report.outside, 22u);
}

TEST(Evt21Reader, WrapsWhenTimeHighFallsByHalfItsRange) {
  const int64_t loop = int64_t{1} << 34;
  const auto r = read_all(little_file({high(0x0FFFFFFF), row(1, 63, 0, 0, 1), high(0), row(1, 0, 0, 0, 1)}));
  EXPECT_THAT(r.events, ElementsAre(Event{loop - 1, 0, 0, 1}, Event{loop, 0, 0, 1}));
}

TEST(Evt21Reader, ReportsThePartialWordAtTheEnd) {
  Bytes bytes = little_file({high(0), row(1, 0, 0, 0, 1)});
  bytes.resize(bytes.size() - 3);
  const auto r = read_all(bytes);
  EXPECT_THAT(r.events, IsEmpty());
  EXPECT_EQ(r.report.truncated_bytes, 5u);
}

}  // namespace
}  // namespace scarf
