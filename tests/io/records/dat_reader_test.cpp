#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kEvents = "\x0C\x08";

Bytes dat_file(std::string_view header, std::string_view type, std::initializer_list<uint32_t> words) {
  return with_words(std::string(header) + std::string(type), words);
}

TEST(DatReader, DecodesVersion2ByBit) {
  const auto r = read_all(dat_file("% Version 2\n% Width 304\n% Height 240\n% end\n", kEvents,
                                   {7, 0b0001'00000011101111'00000100101111u, 8, 0, 9, 0b1000u << 28}));
  EXPECT_EQ(r.format, "dat");
  EXPECT_EQ(r.sensor, (SensorSize{304, 240}));
  EXPECT_THAT(r.events, ElementsAre(Event{7, 303, 239, 1}, Event{8, 0, 0, 0}, Event{9, 0, 0, 1}));
}

TEST(DatReader, DecodesVersion1ByBit) {
  const auto r = read_all(
      dat_file("% Version 1\n", std::string_view("\0\x08", 2), {7, 0b1'11101111'100101111u, 8, 0x1FFu}));
  EXPECT_THAT(r.events, ElementsAre(Event{7, 303, 239, 1}, Event{8, 511, 0, 0}));
}

TEST(DatReader, OldFilesWithoutAHeaderAreReadByName) {
  const Bytes bytes = with_words<uint32_t>("", {7, 0b1'11101111'100101111u});
  EXPECT_THAT(read_all(bytes).error, HasSubstr("ReadOptions::format"));
  const auto r = read_all(bytes, {.sensor = SensorSize{304, 240}, .format = "dat"});
  EXPECT_THAT(r.events, ElementsAre(Event{7, 303, 239, 1}));
  EXPECT_EQ(r.sensor, (SensorSize{304, 240}));
}

TEST(DatReader, WrapsWhenTheTimeFallsByHalfItsRange) {
  const auto r = read_all(
      dat_file("% Version 2\n", kEvents, {0xFFFFFFFFu, 0, 0, 0, 0x80000000u, 0, 1, 0, 0x7FFFFFFFu, 0, 5, 0}));
  const int64_t loop = int64_t{1} << 32;
  EXPECT_THAT(r.events, ElementsAre(Event{loop - 1, 0, 0, 0}, Event{loop, 0, 0, 0},
                                    Event{loop + 0x80000000ll, 0, 0, 0}, Event{loop + 1, 0, 0, 0},
                                    Event{loop + 0x7FFFFFFF, 0, 0, 0}, Event{loop + 5, 0, 0, 0}));
  EXPECT_EQ(r.report.back_steps, 2u);
}

TEST(DatReader, SaysWhatItDoesNotRead) {
  const auto error = [](std::string_view header, std::string_view type) {
    return read_all(dat_file(header, type, {0, 0})).error;
  };
  EXPECT_THAT(error("% Version 2\n", "\x0E\x08"), HasSubstr("open_triggers()"));
  EXPECT_THAT(error("% Version 2\n", "\x28\x10"), HasSubstr("16 bytes"));
  EXPECT_THAT(error("% Version 2\n", "\x0D\x08"), HasSubstr("type 13"));
  EXPECT_THAT(error("% Version 3\n", kEvents), HasSubstr("Version 3"));
  EXPECT_THAT(error("% Data events\n", std::string_view("\0\x08", 2)), HasSubstr("% Version 1"));
  EXPECT_EQ(error("% Data events\n", kEvents), "") << "events of type 12 are of version 2";
  EXPECT_THAT(read_all(bytes_of("% Version 2\n")).error, HasSubstr("ends"));
  EXPECT_THAT(error("% Version 2\n% Width 304\n", kEvents), HasSubstr("Width and Height"));
}

TEST(DatReader, ReportsThePartialRecordAtTheEnd) {
  Bytes bytes = dat_file("% Version 2\n", kEvents, {1, 1, 2, 2});
  bytes.resize(bytes.size() - 1);
  const auto r = read_all(bytes);
  EXPECT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.report.truncated_bytes, 7u);
}

}  // namespace
}  // namespace scarf
