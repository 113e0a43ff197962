// YARP event-driven logs, versions 1 and 2, line by line.
#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr uint32_t kLeft = 0;
constexpr uint32_t kRight = 1;

// A record's word, with the bits as event-driven lays them: polarity 0 is brighter.
uint32_t word(uint32_t x, uint32_t y, uint32_t p, uint32_t camera = kLeft) {
  return (1 - p) | x << 1 | y << 12 | camera << 22;
}

// Bytes as YARP's text form escapes them.
std::string escaped(const Bytes& bytes) {
  std::string text;
  for (const uint8_t byte : bytes) {
    if (byte == 0) {
      text += "\\0";
    } else if (byte == '\n') {
      text += "\\n";
    } else if (byte == '\r') {
      text += "\\r";
    } else if (byte == '\\' || byte == '"') {
      text += {'\\', static_cast<char>(byte)};
    } else {
      text += static_cast<char>(byte);
    }
  }
  return text;
}

std::string packet(const std::string& stamps, int duration, std::initializer_list<uint32_t> words) {
  Bytes bytes;
  for (const uint32_t w : words) append_little_endian(bytes, w);
  return stamps + " AE " + std::to_string(duration) + " \"" + escaped(bytes) + "\"\n";
}

Recording read_log(const std::string& log, const ReadOptions& options = {}) {
  return read_all(bytes_of(log), options);
}

TEST(YarpReader, Version1HasTicksOf80Nanoseconds) {
  const std::string log = "7 1569859363.5 AE (25 " + std::to_string(word(5, 6, 1)) + " 51 " +
                          std::to_string(word(2047, 1023, 0)) + ")\n8 1569859364.5 AE ()\n";
  const auto r = read_log(log);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "yarp");
  EXPECT_EQ(r.sensor, std::nullopt);
  EXPECT_THAT(r.events, ElementsAre(Event{2, 5, 6, 1}, Event{4, 2047, 1023, 0}));
  const auto in_us = read_log(log, read_options("", "", "us"));
  EXPECT_THAT(in_us.events, ElementsAre(Event{25, 5, 6, 1}, Event{51, 2047, 1023, 0}));
  EXPECT_THAT(read_log(log, read_options("", "", "ms")).error, HasSubstr("80 ns"));
}

TEST(YarpReader, TicksWrapAfter30Bits) {
  const std::string event = " " + std::to_string(word(1, 2, 1));
  const auto r = read_log("1 1.0 AE (1073741800" + event + ")\n2 1.1 AE (1" + event + " 26" + event + ")\n");
  ASSERT_EQ(r.events.size(), 3u);
  EXPECT_EQ(r.events[0].t, 85'899'344);
  EXPECT_EQ(r.events[1].t, 85'899'346);  // 2^30 + 1 ticks
  EXPECT_EQ(r.events[2].t, 85'899'348);
  EXPECT_EQ(r.report.back_steps, 0u);
}

TEST(YarpReader, Version2HasTheTimesOfItsPackets) {
  // Places whose bytes need every escape: 0, LF, CR, backslash, quote.
  const std::string log =
      packet("1 10.000004", 3, {word(5, 0x0A, 1), word(0x85, 0x0D, 0), word(0x2E, 0x5, 1)}) +
      packet("2 10.5", 9, {0x00222222, 0x00005C5C}) + "3 10.6 IMUS (1 2 3)\n" + packet("4 11.0", 0, {});
  const auto r = read_log(log);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.report.damages, 0u);
  EXPECT_THAT(r.events, ElementsAre(Event{10'000'004, 5, 10, 1}, Event{10'000'004, 0x85, 13, 0},
                                    Event{10'000'004, 0x2E, 5, 1},
                                    Event{10'500'000, 0x2222 >> 1 & 0x7FF, 0x00222222 >> 12 & 0x3FF, 1},
                                    Event{10'500'000, 0x5C5C >> 1 & 0x7FF, 0x5C5C >> 12, 1}));
  ReadOptions options;
  options.yarp_time = "spread";
  const auto spread = read_log(log, options);
  ASSERT_EQ(spread.events.size(), 5u);
  EXPECT_EQ(spread.events[0].t, 10'000'002);
  EXPECT_EQ(spread.events[1].t, 10'000'003);
  EXPECT_EQ(spread.events[2].t, 10'000'004);
  options.yarp_time = "packet";
  EXPECT_EQ(read_log(log, options).events, r.events);
  options.yarp_time = "even";
  EXPECT_THAT(read_log(log, options).error, HasSubstr("packet or spread"));
}

TEST(YarpReader, Version2WithTicks) {
  std::string log;
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t ticks = 100'000'000 + 100 * i;
    log += packet(std::to_string(i) + " 3.5 3.6", 5, {ticks, word(i, 2, 1), ticks + 25, word(i, 3, 0)});
  }
  const auto r = read_log(log);
  EXPECT_EQ(r.error, "");
  ASSERT_EQ(r.events.size(), 16u);
  EXPECT_EQ(r.events[0], (Event{8'000'000, 0, 2, 1}));
  EXPECT_EQ(r.events[15], (Event{8'000'000 + 56 + 2, 7, 3, 0}));
  ReadOptions options;
  options.yarp_time = "packet";
  EXPECT_THAT(read_log(log, options).error, HasSubstr("leave ReadOptions::yarp_time out"));
  // Without ticks there is no unit to name.
  EXPECT_THAT(read_log(packet("1 2.5", 3, {word(1, 2, 1)}), read_options("", "", "us")).error,
              HasSubstr("no ticks"));
}

TEST(YarpReader, OfTwoCamerasOneIsChosen) {
  const std::string log = packet("1 1.0", 0, {word(1, 2, 1, kLeft), word(3, 4, 0, kRight)}) +
                          packet("2 1.5", 0, {word(5, 6, 1, kLeft)});
  EXPECT_THAT(read_log(log).error, HasSubstr("ReadOptions::stream"));
  EXPECT_THAT(read_log(log, read_options("left")).events,
              ElementsAre(Event{1'000'000, 1, 2, 1}, Event{1'500'000, 5, 6, 1}));
  EXPECT_THAT(read_log(log, read_options("right")).events, ElementsAre(Event{1'000'000, 3, 4, 0}));
  EXPECT_THAT(read_log(log, read_options("middle")).error, HasSubstr("left or right"));
}

TEST(YarpReader, BrokenPacketsArePassedOver) {
  const auto good = [](int x) { return packet("1 1.0", 0, {word(static_cast<uint32_t>(x), 2, 1)}); };
  for (const std::string broken :
       {"1 1.0 AE 0 \"\\x\"\n", "1 1.0 AE 0 \"abcd\n", "1 1.0 AE -1 \"abcd\"\n", "1 1.0 AE (1 2 3)\n",
        "1 1.0 AE (1 2\n", "x 1.0 AE ()\n", "1 soon AE ()\n", "1 1.0 AE 0 \"\\1\\0\\0\"\n", "1 1.0\n"}) {
    const auto r = read_log(good(1) + broken + good(3));
    EXPECT_EQ(r.error, "") << broken;
    EXPECT_EQ(r.events.size(), 2u) << broken;
    EXPECT_EQ(r.report.damages, 1u) << broken;
    ReadOptions strict;
    strict.strict = true;
    EXPECT_NE(read_log(good(1) + broken + good(3), strict).error, "") << broken;
  }
  const auto fill = read_log(packet("1 1.0", 0, {word(1, 2, 1), 0x04000000, word(3, 2, 1)}));
  EXPECT_EQ(fill.events.size(), 2u);
  EXPECT_EQ(fill.report.damages, 1u);
  const auto cut = read_log(good(1) + "2 1.1 AE 0 \"ab");
  EXPECT_EQ(cut.events.size(), 1u);
  EXPECT_EQ(cut.report.truncated_bytes, 14u);
}

TEST(YarpReader, AFolderHasDataAndInfo) {
  const TemporaryFolder folder;
  folder.add("data.log", bytes_of(packet("1 1.0", 0, {word(1, 2, 1)})));
  EXPECT_THAT(read_path(folder.path()).error, HasSubstr("no recording that scarf knows"));
  folder.add("info.log", bytes_of("Type: Bottle;\n"));
  const auto r = read_path(folder.path());
  EXPECT_EQ(r.format, "yarp");
  EXPECT_THAT(r.events, ElementsAre(Event{1'000'000, 1, 2, 1}));
}

}  // namespace
}  // namespace scarf
