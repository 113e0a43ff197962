#include <gmock/gmock.h>

#include "io/base/decimal.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::AllOf;
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
      {"4.600e+03", 4'600'000'000},
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

TEST(Decimal, WholeNumbersHoweverTheyAreWritten) {
  const struct {
    const char* token;
    int64_t value;
  } cases[] = {{"30", 30},
               {"30.", 30},
               {"30.000000", 30},
               {"3.000000000000000000e+01", 30},
               {"3e1", 30},
               {"3000E-2", 30},
               {"0.0", 0},
               {"0e0", 0},
               {"-0.0", 0},
               {"-1.000e+00", -1},
               {"+2.0", 2},
               {"1e30", int64_t{1} << 31},
               {"-1e30", -(int64_t{1} << 31)},
               {"99999999999999999999.0", int64_t{1} << 31}};
  for (const auto& c : cases) EXPECT_EQ(whole_from(c.token), c.value) << c.token;
  for (const char* token :
       {"", ".", "30.5", "30.0000000001", "3e-1", "1e-400", "nan", "inf", "1.0.0", "1,0", "0x1"}) {
    EXPECT_EQ(whole_from(token), std::nullopt) << token;
  }
}

TEST(TextReader, AcceptsEverySeparatorLineEndAndPolarity) {
  for (const std::string separator : {" ", "\t", ",", ";", "  ", " \t ", " , ", "; "}) {
    SCOPED_TRACE(separator);
    std::string lines = "# t x y p\n\n";
    for (const char* line : {"0.1 1 2 1\n", "0.2 3 4 0\r\n", "0.3 5 6 -1\n", " 0.4 7 8 true\n",
                             "0.5 9 10 OFF \n", "-0.5 1 1 1.0"}) {
      for (const char* c = line; *c != 0; ++c) {
        const bool between = *c == ' ' && c != line && c[1] != '\n';
        lines += between ? separator : std::string(1, *c);
      }
    }
    const auto r = read_text(lines);
    EXPECT_EQ(r.format, "text");
    EXPECT_EQ(r.sensor, std::nullopt);
    EXPECT_THAT(r.events,
                ElementsAre(Event{100'000, 1, 2, 1}, Event{200'000, 3, 4, 0}, Event{300'000, 5, 6, 0},
                            Event{400'000, 7, 8, 1}, Event{500'000, 9, 10, 0}, Event{-500'000, 1, 1, 1}));
    EXPECT_EQ(r.report.unknown_words, 0u);
    EXPECT_EQ(r.report.back_steps, 1u);
    EXPECT_EQ(r.report.largest_back_step, 1'000'000);
  }
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
  EXPECT_EQ(r.report.unknown_words, 4u);
  EXPECT_EQ(r.report.undefined_polarities, 1u);
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
  EXPECT_THAT(read_text("1000 1 2 1\n2500 3 4 0\n").error, HasSubstr("ReadOptions::time_unit"));
  // A fraction anywhere in the beginning decides.
  EXPECT_EQ(read_text("1 1 2 1\n2.5 3 4 0\n").error, "");
}

TEST(Columns, OfTwoCamerasOneIsChosen) {
  const std::string lines = "10 1 2 1 0 5.5\n20 3 4 0 1 5.5\n30 5 6 1 0 5.5\n";
  EXPECT_THAT(read_text(lines, read_options("", "txypc_", "us")).error, HasSubstr("ReadOptions::stream"));
  EXPECT_THAT(read_text(lines, read_options("0", "txypc_", "us")).events,
              ElementsAre(Event{10, 1, 2, 1}, Event{30, 5, 6, 1}));
  EXPECT_THAT(read_text(lines, read_options("1", "txypc_", "us")).events, ElementsAre(Event{20, 3, 4, 0}));
  EXPECT_THAT(read_text("0.1 1 2 1\n", read_options("1")).error, HasSubstr("camera"));
}

// Three events, in whole microseconds and with the columns in an order that is not the format's own.
const std::vector<Event> kThree = {{23, 30, 235, 0}, {48, 333, 72, 1}, {1'000'048, 7, 8, 1}};

// `line(t, x, y, p)` of each of them behind the first lines.
template <class Line>
std::string lines_of_three(std::string first, Line line) {
  for (const Event& e : kThree) {
    first +=
        line(std::to_string(e.t), std::to_string(e.x), std::to_string(e.y), std::to_string(int{e.p})) + "\n";
  }
  return first;
}

using Text = std::string;

TEST(Columns, AreNamedInManyWays) {
  const auto xytp = [](const Text& separator, const Text& end = "") {
    return [=](const Text& t, const Text& x, const Text& y, const Text& p) {
      return x + separator + y + separator + t + separator + p + end;
    };
  };
  const Text bom = "\xef\xbb\xbf";
  const struct {
    Text first;
    Text separator;
    Text end = "";
  } cases[] = {{"x,y,t,p\n", ","},
               {"X,Y,T,P\n", ","},
               {"\"x\",\"y\",\"t\",\"p\"\n", ","},
               {"'x','y','t','p'\r\n", ",", "\r"},
               {bom + "x,y,t,p\r\n", ",", "\r"},
               {bom + "\"x\";\"y\";\"timestamp\";\"polarity\"\r\n", ";", "\r"},
               {"# x,y,t,p\n", ","},
               {"#x y t p\n", " "},
               {"# columns: x y ts pol\n", ","},
               {"# made by a camera\n# x,y,t,p\n# 3 events\n", ","},
               {"x;y;t;p\n", ";"},
               {"x ; y ; t ; p\n", " ; "},
               {"x\ty\tt\tp\n", "\t"},
               {"\"x\"\t\"y\"\t\"timestamp\"\t\"p\"\n", "\t"},
               {"x y ts pol\n", " "},
               {"\"x\" \"y\" \"time stamp\" \"pol\"\n", " "},
               {"x,y,time,on,\n", ",", ","},
               {"x,y,timestamps,polarities\n", ",", ","},
               {"%x,y,t,p\n", ","},
               {"Recorded in the garden\nx,y,t,p\n", ","},
               {"x [px],y [px],event_timestamp,event_polarity\n", ","}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.first);
    const auto r = read_text(lines_of_three(c.first, xytp(c.separator, c.end)), read_options("", "", "us"));
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.events, kThree);
    EXPECT_EQ(r.report.unknown_words, 0u);
  }
}

TEST(Columns, NamesMaySayTheUnit) {
  const auto lines = [](const Text& name, const Text& zeros) {
    return lines_of_three("x;y;" + name + ";polarity\n",
                          [&](const Text& t, const Text& x, const Text& y, const Text& p) {
                            return x + ";" + y + ";" + t + zeros + ";" + p;
                          });
  };
  for (const char* name :
       {"time_us", "t_us", "timestamp [us]", "Timestamp(us)", "\"ts_us\"", "timestamp_microseconds"}) {
    EXPECT_EQ(read_text(lines(name, "")).events, kThree) << name;
    EXPECT_EQ(read_text(lines(name, ".0")).events, kThree) << name;
  }
  for (const char* name : {"t_ns", "timestamp [ns]"})
    EXPECT_EQ(read_text(lines(name, "000")).events, kThree) << name;
  EXPECT_EQ(read_text(lines("timestamp_s", "e-6")).events, kThree);
  EXPECT_EQ(read_text(lines("t_ms", "e-3")).events, kThree);
  // What is asked for counts.
  EXPECT_EQ(read_text(lines("t_us", "000"), read_options("", "", "ns")).events, kThree);
  EXPECT_THAT(read_text(lines("timestamp", "")).error, HasSubstr("ReadOptions::time_unit"));
}

TEST(Columns, EmptyFieldsAreFieldsWhereAMarkPartsThem) {
  const auto us = read_options("", "", "us");
  // As pandas writes an index, and a label that is not always there.
  EXPECT_EQ(read_text(",x,y,p,t\n0,30,235,0,23\n1,333,72,1,48\n2,7,8,1,1000048\n", us).events, kThree);
  EXPECT_EQ(read_text("\tx\ty\tp\tt\n0\t30\t235\t0\t23\n1\t333\t72\t1\t48\n2\t7\t8\t1\t1000048\n", us).events,
            kThree);
  EXPECT_EQ(read_text("t,x,y,p,label\n23,30,235,0,\n48,333,72,1,\"a, b\"\n1000048,7,8,1,\n", us).events,
            kThree);
  EXPECT_EQ(read_text("t,,x,y,p\n23,,30,235,0\n48,,333,72,1\n1000048,,7,8,1\n", us).events, kThree);
  EXPECT_EQ(read_text("t;x;y;p\n\"23\";\"30\";\"235\";\"0\"\n48;333;72;1\n1000048;7;8;\"1\"\n", us).events,
            kThree);
  const auto r = read_text("t,x,y,p\n23,,235,0\n48,333,72,1\n1000048,7,8,\n", us);
  EXPECT_THAT(r.events, ElementsAre(kThree[1]));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Columns, NumbersWithDecimalsInEveryColumn) {
  const Text savetxt =
      "7.000000000000000000e+00 8.500000000000000000e+01 2.939999999999999905e-04 0.000000000000000000e+00\n"
      "7.200000000000000000e+01 4.200000000000000000e+01 5.199999999999999544e-04 1.000000000000000000e+00\n"
      "5.400000000000000000e+01 3.700000000000000000e+01 8.050000000000000515e-04 "
      "-1.000000000000000000e+00\n";
  const std::vector<Event> three = {{294, 7, 85, 0}, {520, 72, 42, 1}, {805, 54, 37, 0}};
  EXPECT_EQ(read_text(savetxt, read_options("", "xytp", "s")).events, three);
  // The order is not the format's own: told, with the one that fits.
  EXPECT_THAT(read_text(savetxt).error, HasSubstr("ReadOptions::columns xytp"));
  EXPECT_EQ(
      read_text("0.000294 7.000000 85.000000 0.000000\n0.00052 72. 42.0 1.0\n805e-6 54.0 37 -1.0\n").events,
      three);
  // Whole microseconds, as floating-point numbers are printed, are no seconds.
  EXPECT_THAT(read_text("t,x,y,p\n23.0,30.0,235.0,0.0\n48.0,333.0,72.0,1.0\n").error,
              HasSubstr("ReadOptions::time_unit"));
  // A place between pixels is none of a pixel.
  const auto r = read_text("0.1 1.0 2.0 1\n0.2 1.5 2.0 1\n0.3 1.0 2.25 1\n", read_options("", "txyp"));
  EXPECT_THAT(r.events, ElementsAre(Event{100'000, 1, 2, 1}));
  EXPECT_EQ(r.report.unknown_words, 2u);
}

TEST(Columns, NamesThatAreNotUnderstoodAreRefused) {
  for (const char* first : {"zeit,spalte,zeile,pol\n", "a;b;c;d\n", "\"stamp\"\t\"u\"\t\"v\"\t\"sign\"\n",
                            "t,timestamp,x,y,p\n", "// t x y p in no order\n"}) {
    const Text separator = Text(first).find(';') != Text::npos   ? ";"
                           : Text(first).find(',') != Text::npos ? ","
                                                                 : " ";
    const Text lines = lines_of_three(first, [&](const Text& t, const Text& x, const Text& y, const Text& p) {
      return t + separator + x + separator + y + separator + p;
    });
    EXPECT_THAT(read_text(lines, read_options("", "", "us")).error, HasSubstr("ReadOptions::columns"))
        << first;
    const auto named = read_text(lines, read_options("", "txyp", "us"));
    EXPECT_EQ(named.events, kThree) << first;
    EXPECT_EQ(named.report.unknown_words, 0u) << first;
  }
  EXPECT_THAT(read_text("t,x,y,p\n1,2,3,1,5\n2,3,4,0,5\n", read_options("", "", "us")).error,
              HasSubstr("5 columns"));
}

TEST(Columns, LinesThatNobodyUnderstandsAreNoEmptyRecording) {
  for (const char* lines :
       {"event_timestamp,x,y,polarity\n2026-01-01 00:00:00.000023,30,235,0\n2026-01-01 "
        "00:00:00.000048,3,7,1\n",
        "t x y p\n2026-01-01T00:00:00.000023 30 235 0\n", "2026/01/01 00:00:00.000023 30 235 0\n",
        "12:00:00.000023;30;235;0\n12:00:00.000048;3;7;1\n"}) {
    EXPECT_THAT(read_text(lines).error, HasSubstr("dates")) << lines;
  }
  // A date in a column that is not looked at is none of our business.
  EXPECT_EQ(read_text("t,x,y,p,day\n0.5,1,2,1,2026-01-01\n").events.size(), 1u);
  for (const char* lines : {"t,x,y,p\n0.1,1.5,2.5,1\n0.2,3.5,4.5,0\n",
                            "t,x,y,p\n0.1,a,b,1\n0.2,c,d,0\n1,2,3,up\n", "0.1 1 2 up\n"}) {
    EXPECT_NE(read_text(lines, read_options("", "", "s", "text")).error, "") << lines;
  }
}

TEST(Columns, WithoutNamesTheOrderMustSuitTheLines) {
  // A hundred events in several orders: only the first is the format's own.
  for (const Text order : {"txyp", "xytp", "xypt", "tpxy", "pxyt", "txy_p", "_xytp"}) {
    Text lines;
    uint32_t random = 1;
    for (int i = 0; i < 100; ++i) {
      random = random * 1664525 + 1013904223;
      for (const char column : order) {
        if (column == 't') lines += std::to_string(100 * i) + "e-6 ";
        if (column == 'x') lines += std::to_string(random >> 8 & 127) + " ";
        if (column == 'y') lines += std::to_string(random >> 20 & 127) + " ";
        if (column == 'p') lines += std::to_string(random >> 30 & 1) + " ";
        if (column == '_') lines += "7.5 ";
      }
      lines += "\n";
    }
    const auto plain = read_text(lines);
    if (order == "txyp") {
      EXPECT_EQ(plain.events.size(), 100u);
    } else {
      EXPECT_THAT(plain.error, HasSubstr("ReadOptions::columns " + order)) << order;
    }
    EXPECT_EQ(read_text(lines, read_options("", order)).events.size(), 100u) << order;
  }
}

// What lies beside recordings is none; what a recording should be is refused for another reason.
TEST(TextReader, TablesOfOtherThingsAreNoRecordings) {
  const auto code = [](const Text& lines, const ReadOptions& options = {}) {
    const auto source = open_input(ByteReader::over(bytes_of(lines)), "test.txt", options);
    return source.ok() ? std::nullopt : std::optional(source.error().code);
  };
  for (const char* other :
       {"10,20,30,40\n11,20,30,40\n",                                           // boxes
        "1600000000.1 0.1 0.2 9.8 0 0 0\n",                                     // of an inertial unit
        "# time tx ty tz qx qy qz qw\n1600000000.1 0 0 0 0 0 0 1\n",            // poses
        "timestamp,ax,ay,az,gx,gy,gz\n1.5,0,0,9.8,0,0,0\n2.5,0,0,9.8,0,0,1\n",  //
        "ts,x,y,w,h,class_id\n100,10,20,30,40,1\n200,10,20,30,40,0\n",          //
        "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",                                 // a matrix
        "0.5 0.25 0.75 1.5\n0.25 0.5 1.5 1.25\n",                               //
        "1,1,912,484,97,109,0,7,1\n2,1,912,484,97,109,1,7,1\n",                 // tracks
        "0 0.51 0.33 0.1 0.2\n1 0.2 0.25 0.1 0.3\n",                            // boxes of a network
        "intrinsics:\n  cam0:\n    matrix: [1, 1, 1, 1]\n", "49599300523\n49599350523\n"}) {
    EXPECT_EQ(code(other), ErrorCode::unrecognised) << other;
  }
  for (const char* recording :
       {"x,y,zeit,polarity\n1,2,300,1\n", "zeit,y,x,p\n300,1,2,1\n", "1000 1 2 1\n2000 3 4 0\n",
        "3 9 0.5 1\n1 7 0.75 0\n", "t,x,y,p\n2026-01-01,1,2,1\n", "t;x;y;p\n0,5;1;2;1\n0,75;1;2;1\n"}) {
    EXPECT_EQ(code(recording), ErrorCode::bad_input) << recording;
  }
}

TEST(TextReader, PolaritiesThatTheFormatDoesNotDefineAreCounted) {
  const auto r = read_text(
      "t,x,y,p\n0.1,1,2,True\n0.2,1,2,2\n0.3,1,2,255\n0.4,1,2,-3\n0.5,1,2,nan\n0.6,1,2,0.5\n"
      "0.7,1,2,-1.0\n0.8,1,2,up\n0.9,1,2,ON\n1.0,70000,2,7\n");
  EXPECT_THAT(r.events,
              ElementsAre(Event{100'000, 1, 2, 1}, Event{700'000, 1, 2, 0}, Event{900'000, 1, 2, 1}));
  EXPECT_EQ(r.report.undefined_polarities, 6u);
  EXPECT_EQ(r.report.unknown_words, 1u);
  EXPECT_EQ(r.report.outside, 0u);
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THAT(read_text("t,x,y,p\n0.1,1,2,1\n0.2,1,2,2\n", strict).error,
              AllOf(HasSubstr("byte 18"), HasSubstr("polarity"), HasSubstr("ReadOptions::strict")));
}

TEST(Csv, GeometryMayComeWithNames) {
  const Text lines = lines_of_three("%geometry:346,260\nx,y,polarity,timestamp_us\n",
                                    [](const Text& t, const Text& x, const Text& y, const Text& p) {
                                      return x + "," + y + "," + p + "," + t;
                                    });
  const auto r = read_text(lines);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "csv");
  EXPECT_EQ(r.sensor, (SensorSize{346, 260}));
  EXPECT_EQ(r.events, kThree);
  // Lines that do not suit OpenEB's order are not taken for it.
  EXPECT_THAT(read_text("%geometry:346,260\n23,30,235,0\n48,333,72,1\n59,7,8,1\n").error,
              HasSubstr("ReadOptions::columns txyp"));
}

}  // namespace
}  // namespace scarf
