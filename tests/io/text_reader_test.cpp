#include <gmock/gmock.h>

#include "io/decimal.h"
#include "io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Recording read_text(std::string_view content, const ReadOptions& options = {}) {
  return read_all(bytes_of(content), options);
}

TEST(Decimal, SecondsToMicrosecondsExactly) {
  const struct {
    const char* token;
    int64_t t;
  } cases[] = {
      {"0", 0},
      {"0.000003", 3},
      {"1.5", 1'500'000},
      {".25", 250'000},
      {"7.", 7'000'000},
      {"+2", 2'000'000},
      {"0.0000004", 0},
      {"0.0000005", 1},
      {"0.00000049999999999999999999", 0},
      {"0.9999995", 1'000'000},
      {"-0.000001", -1},
      {"-0.0000005", 0},  // half up is towards plus infinity
      {"-0.00000050000001", -1},
      {"-0.0000015", -1},
      {"-1.25", -1'250'000},
      {"1468941032.229165635", 1'468'941'032'229'166},  // a double would be off here
      {"9007199254.740993", 9'007'199'254'740'993},
      {"1.250000000000000000e-03", 1250},
      {"1.25E3", 1'250'000'000},
      {"5e-7", 1},
      {"5e-8", 0},
      {"9e-2147483648", 0},
      {"0e99999999999999999999", 0},
      {"4611686018427.387903", (int64_t{1} << 62) - 1},
      {"00000000000000000000000000001", 1'000'000},
  };
  for (const auto& c : cases) EXPECT_EQ(microseconds_from_seconds(c.token), c.t) << c.token;
  for (const char* token :
       {"", ".", "-", "1.2.3", "1e", "e5", "nan", "inf", "0x10", "1,5", "--1", "1e5e5",
        "4611686018427.387904", "4611686018427.3879035", "99999999999999999999", "1e30", "1e13"}) {
    EXPECT_EQ(microseconds_from_seconds(token), std::nullopt) << token;
  }
}

TEST(TextReader, AcceptsEverySeparatorLineEndAndPolarity) {
  const auto r = read_text(
      "# t x y p\n\n0.1 1 2 1\n0.2\t3\t4\t0\r\n0.3,5,6,-1\n 0.4, 7, 8, true\n0.5  9 10  false \n-0.5 1 1 1");
  EXPECT_EQ(r.format, "text");
  EXPECT_EQ(r.sensor, std::nullopt);
  EXPECT_THAT(r.events,
              ElementsAre(Event{100'000, 1, 2, 1}, Event{200'000, 3, 4, 0}, Event{300'000, 5, 6, 0},
                          Event{400'000, 7, 8, 1}, Event{500'000, 9, 10, 0}, Event{-500'000, 1, 1, 1}));
  EXPECT_EQ(r.report.unknown_words, 0u);
  EXPECT_EQ(r.report.back_steps, 1u);
  EXPECT_EQ(r.report.largest_back_step, 1'000'000);
}

TEST(TextReader, TakesTheSensorFromTheFirstLine) {
  const auto r = read_text("# comment\n240 180\n0.1 239 179 1\n0.2 240 0 1\n0.3 0 180 1\n");
  EXPECT_EQ(r.sensor, (SensorSize{240, 180}));
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 239, 179, 1}));
  EXPECT_EQ(r.report.outside, 2u);
}

TEST(TextReader, ASensorSizeAloneIsAnEmptyRecording) {
  const auto r = read_text("240 180\n");
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.sensor, (SensorSize{240, 180}));
}

TEST(TextReader, RefusesAnIllegalSensor) {
  EXPECT_THAT(read_text("0 180\n0.1 1 1 1\n").error, HasSubstr("0x180"));
  EXPECT_THAT(read_text("99999 180\n0.1 1 1 1\n").error, HasSubstr("99999x180"));
}

TEST(TextReader, CoordinatesBeyondSixteenBitsAreOutsideAndNeverWrap) {
  const auto r = read_text("0.2 65536 0 1\n0.1 0 99999999999999999999999 1\n0.1 -1 0 1\n0.1 65535 65535 1\n");
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 65535, 65535, 1}));
  EXPECT_EQ(r.report.outside, 3u);
  EXPECT_EQ(r.report.back_steps, 1u);
}

TEST(TextReader, CountsLinesThatAreNoEvents) {
  const auto r =
      read_text("t x y p\n0.1 1 2 1\n0.1 1 2\n0.1 1 2 2\n0.1 1 2 1 0\n0.1 1.5 2 1\nabc\n0.2 3 4 0\n");
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 1, 2, 1}, Event{200'000, 3, 4, 0}));
  EXPECT_EQ(r.report.unknown_words, 5u);
}

TEST(TextReader, AFileWithoutAnyEventIsNotRecognised) {
  EXPECT_THAT(read_text("hello\nworld\n").error, HasSubstr("not recognised"));
  EXPECT_THAT(read_text("1 2\n3 4\n5 6\n").error, HasSubstr("not recognised"));
  // Six columns: two cameras in one file.
  EXPECT_THAT(read_text("40266 4 90 0 1 8.234278\n69686 239 74 1 1 14.211559\n").error,
              HasSubstr("6 columns"));
}

TEST(TextReader, ReportsALineCutAtTheEnd) {
  const auto r = read_text("0.1 1 2 1\n0.2 1");
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 1, 2, 1}));
  EXPECT_EQ(r.report.truncated_bytes, 5u);
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(TextReader, SkipsLinesOfAnyLengthWithinItsBuffer) {
  const auto r = read_text("0.1 1 2 1\n" + std::string(3'000'000, '7') + "\n0.2 3 4 0\n" +
                           std::string(5000, ' ') + "\n0.3 3 4 0\n");
  EXPECT_THAT(r.events,
              ElementsAre(Event{100'000, 1, 2, 1}, Event{200'000, 3, 4, 0}, Event{300'000, 3, 4, 0}));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Csv, OfOpenEbSaysItsSensorAndHasMicroseconds) {
  const auto r = read_text("%geometry:640,480\n1,2,1,100\n3,4,0,250\n640,0,1,300\n");
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "csv");
  EXPECT_EQ(r.sensor, (SensorSize{640, 480}));
  EXPECT_THAT(r.events, ElementsAre(Event{100, 1, 2, 1}, Event{250, 3, 4, 0}));
  EXPECT_EQ(r.report.outside, 1u);
  EXPECT_EQ(read_text("1,2,1,100\n3,4,0,250\n", read_options("", "", "", "csv")).events, r.events);
  const auto empty = read_text("%geometry:640,480\n");
  EXPECT_EQ(empty.format, "csv");
  EXPECT_EQ(empty.sensor, (SensorSize{640, 480}));
}

TEST(Csv, OfFaeryNamesItsColumns) {
  const auto r = read_text("t,x,y,on\n100,1,2,true\n250,3,4,false\n");
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events, ElementsAre(Event{100, 1, 2, 1}, Event{250, 3, 4, 0}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST(Columns, NamesInTheFirstLineCount) {
  const auto r = read_text("X, Y, Polarity, Timestamp, speed\n1,2,1,0.5,9\n3,4,0,0.75,9\n");
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(r.events, ElementsAre(Event{500'000, 1, 2, 1}, Event{750'000, 3, 4, 0}));
}

TEST(Columns, OptionsSayOrderAndUnit) {
  const std::vector<Event> two = {{1000, 1, 2, 1}, {2500, 3, 4, 0}};
  EXPECT_EQ(read_text("1 2 1 7 1\n3 4 0 7 2.5\n", read_options("", "xyp_t", "ms")).events, two);
  EXPECT_EQ(read_text("1000000 1 2 1\n2500000 3 4 0\n", read_options("", "", "ns")).events, two);
  EXPECT_EQ(read_text("1000,1,2,1\n2500,3,4,0\n", read_options("", "txyp", "us")).events, two);
  EXPECT_THAT(read_text("1 2 1 7 1\n3 4 0 7 2.5\n", read_options("", "xypt")).error, HasSubstr("5 columns"));
  EXPECT_THAT(read_text("1 2 1 7\n", read_options("", "xyp")).error, HasSubstr("each of t, x, y and p"));
  EXPECT_THAT(read_text("1 2 3 1\n", read_options("", "", "h")).error, HasSubstr("unit"));
}

TEST(Columns, WholeNumbersCouldBeSecondsOrMicroseconds) {
  EXPECT_THAT(read_text("1000 1 2 1\n2500 3 4 0\n").error, HasSubstr("--time-unit"));
  // A fraction anywhere in the beginning decides.
  EXPECT_EQ(read_text("1 1 2 1\n2.5 3 4 0\n").error, "");
}

TEST(Columns, OfTwoCamerasOneIsChosen) {
  const std::string lines = "10 1 2 1 0 5.5\n20 3 4 0 1 5.5\n30 5 6 1 0 5.5\n";
  EXPECT_THAT(read_text(lines, read_options("", "txypc_", "us")).error, HasSubstr("--stream"));
  EXPECT_THAT(read_text(lines, read_options("0", "txypc_", "us")).events,
              ElementsAre(Event{10, 1, 2, 1}, Event{30, 5, 6, 1}));
  EXPECT_THAT(read_text(lines, read_options("1", "txypc_", "us")).events, ElementsAre(Event{20, 3, 4, 0}));
  EXPECT_THAT(read_text("0.1 1 2 1\n", read_options("1")).error, HasSubstr("camera"));
}

}  // namespace
}  // namespace scarf
