#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kFormats[] = {"dat", "evt2", "evt21", "evt3", "evt4", "es", "npy", "csv", "text"};

// Writes in batches of `batch`; the message of the first error, or "".
std::string write_all(const std::string& path, std::string_view format, SensorSize sensor,
                      std::span<const Event> events, size_t batch = 1 << 20) {
  auto sink = create_events(path, format, sensor, {.overwrite = true});
  if (!sink) return sink.error().message;
  for (size_t at = 0; at < events.size(); at += batch) {
    const auto written = (*sink)->write(events.subspan(at, std::min(batch, events.size() - at)));
    if (!written) return written.error().message;
  }
  const auto finished = (*sink)->finish();
  return finished ? "" : finished.error().message;
}

void expect_round_trip(std::string_view format, SensorSize sensor, const std::vector<Event>& events) {
  SCOPED_TRACE(format);
  const TemporaryFile file;
  for (const size_t batch : {size_t{1} << 20, size_t{7}}) {
    ASSERT_EQ(write_all(file.path(), format, sensor, events, batch), "");
    const auto r = read_all(file.content());
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, format);
    EXPECT_EQ(r.sensor, format == "npy" ? std::nullopt : std::optional(sensor));
    EXPECT_TRUE(r.events == events) << r.events.size() << " of " << events.size();
    EXPECT_EQ(r.report.unknown_words + r.report.outside + r.report.truncated_bytes + r.report.back_steps, 0u);
  }
}

// A stream with rows of neighbours, repeated pixels and gaps of up to `largest_gap` microseconds.
std::vector<Event> random_stream(uint32_t seed, SensorSize sensor, int64_t t, int64_t largest_gap,
                                 size_t count) {
  std::mt19937_64 random(seed);
  const auto below = [&](int64_t n) { return static_cast<int64_t>(random() % static_cast<uint64_t>(n)); };
  std::vector<Event> events;
  while (events.size() < count) {
    if (below(3) == 0) t += below(10);
    if (below(50) == 0) t += below(largest_gap);
    const auto y = static_cast<uint16_t>(below(sensor.height));
    const auto p = static_cast<uint8_t>(below(2));
    int64_t x = below(sensor.width);
    const int64_t run = below(3) == 0 ? 1 + below(60) : 1;
    for (int64_t i = 0; i < run && x < sensor.width; ++i) {
      events.push_back({t, static_cast<uint16_t>(x), y, below(20) == 0 ? static_cast<uint8_t>(1 - p) : p});
      x += below(10) == 0 ? below(20) - 5 : 1 + below(2);
      if (x < 0) x = 0;
    }
  }
  return events;
}

TEST(Writers, RandomStreamsComeBackIdentical) {
  for (const std::string_view format : kFormats) {
    for (uint32_t seed = 0; seed < 8; ++seed) {
      for (const SensorSize sensor : {SensorSize{1280, 720}, SensorSize{2048, 2048}, SensorSize{31, 5},
                                      SensorSize{32, 1}, SensorSize{1, 1}, SensorSize{240, 180}}) {
        expect_round_trip(format, sensor, random_stream(seed, sensor, seed * 1'000'003, 5000, 5000));
      }
    }
  }
}

TEST(Writers, LongGapsAndLateStartsComeBackIdentical) {
  for (const std::string_view format : kFormats) {
    if (format == "dat" || format == "es") continue;  // their clocks have 32 and 34 bits
    const SensorSize sensor{640, 480};
    for (const int64_t start :
         {int64_t{0}, (int64_t{1} << 24) - 3, int64_t{913'716'224}, (int64_t{1} << 36) - 1'000'000}) {
      expect_round_trip(format, sensor, random_stream(1, sensor, start, 4, 3000));
    }
    expect_round_trip(format, sensor, random_stream(2, sensor, 0, 60'000'000, 30'000));
    std::vector<Event> events;
    for (int64_t t = 0; t < int64_t{1} << 36; t = t * 2 + 1) events.push_back({t, 1, 2, 1});
    expect_round_trip(format, sensor, events);
  }
  expect_round_trip("evt2", {640, 480}, {{5, 1, 2, 1}, {(int64_t{1} << 46) - 1, 3, 4, 0}});
}

TEST(Writers, AnEmptyRecordingComesBackEmpty) {
  for (const std::string_view format : kFormats) expect_round_trip(format, {640, 480}, {});
}

TEST(Writers, TextHoldsEveryOrderAndNegativeTimes) {
  const std::vector<Event> events = {{-1, 1, 2, 1}, {-1'000'001, 3, 4, 0}, {(int64_t{1} << 62) - 1, 5, 6, 1}};
  const TemporaryFile file;
  ASSERT_EQ(write_all(file.path(), "text", {16'384, 100}, events), "");
  const Bytes content = file.content();
  EXPECT_EQ(std::string(content.begin(), content.end()),
            "16384 100\n-0.000001 1 2 1\n-1.000001 3 4 0\n4611686018427.387903 5 6 1\n");
  EXPECT_EQ(read_all(content).events, events);
}

TEST(Writers, Evt2WordsAreThoseOfTheFormat) {
  const TemporaryFile file;
  ASSERT_EQ(write_all(file.path(), "evt2", {640, 480}, std::vector<Event>{{65, 3, 2, 1}, {66, 4, 2, 0}}), "");
  EXPECT_EQ(file.content(),
            with_words<uint32_t>("% evt 2.0\n% format EVT2;height=480;width=640\n% geometry 640x480\n% end\n",
                                 {0x80000001u, 0x10401802u, 0x00802002u}));
}

TEST(Writers, Evt21SharesWordsAmongNeighbours) {
  const TemporaryFile file;
  const std::vector<Event> events = {{65, 30, 2, 1}, {65, 31, 2, 1}, {65, 32, 2, 1}, {65, 31, 2, 0}};
  ASSERT_EQ(write_all(file.path(), "evt21", {640, 480}, events), "");
  EXPECT_EQ(
      file.content(),
      with_words<uint64_t>(
          "% evt 2.1\n% format EVT21;endianness=little;height=480;width=640\n% geometry 640x480\n% end\n",
          {0x8000000100000000u, 0x10400002C0000000u, 0x1041000200000001u, 0x0040000280000000u}));
}

TEST(Writers, Evt4WordsAreThoseOfTheFormat) {
  const TemporaryFile file;
  const std::vector<Event> events = {{65, 3, 2, 1}, {65, 5, 2, 1}, {65, 34, 2, 1}, {66, 4, 2, 0}};
  ASSERT_EQ(write_all(file.path(), "evt4", {640, 480}, events), "");
  EXPECT_EQ(file.content(),
            with_words<uint32_t>("% evt 4.0\n% format EVT4;height=480;width=640\n% geometry 640x480\n% end\n",
                                 {0xE0000001u, 0xD0401802u, 0x80000005u, 0xA0802002u}));
}

TEST(Writers, DatRecordsAreThoseOfTheFormat) {
  const TemporaryFile file;
  ASSERT_EQ(write_all(file.path(), "dat", {640, 480}, std::vector<Event>{{65, 3, 2, 1}, {66, 4, 2, 0}}), "");
  EXPECT_EQ(file.content(),
            with_words<uint32_t>(
                "% Data file containing CD events.\n% Version 2\n% Height 480\n% Width 640\n% end\n\x0C\x08",
                {65, 0x10008003u, 66, 0x00008004u}));
  EXPECT_THAT(write_all(file.path(), "dat", {640, 480}, std::vector<Event>{{int64_t{1} << 32, 3, 2, 1}}),
              HasSubstr("shift the times"));
  EXPECT_EQ(write_all(file.path(), "dat", {16'384, 16'384}, std::vector<Event>{{0, 16'383, 16'383, 1}}), "");
}

TEST(Writers, EventStreamBytesAreThoseOfTheFormat) {
  const TemporaryFile file;
  const std::vector<Event> events = {{3, 5, 0, 1}, {257, 258, 239, 0}, {257, 0, 1, 1}, {383, 0, 1, 1}};
  ASSERT_EQ(write_all(file.path(), "es", {320, 240}, events), "");
  Bytes expected = bytes_of("Event Stream");
  const uint8_t rest[] = {2,   0,   0, 1,   0x40, 1, 240, 0,  // version, DVS, 320x240
                          7,   5,   0, 239, 0,                // 3 us on, ON; y from the bottom
                          255, 255, 0, 2,   1,    0, 0,       // 2 x 127 us, 0, OFF
                          1,   0,   0, 238, 0,                // at once, ON
                          253, 0,   0, 238, 0};               // 126 us, ON
  expected.insert(expected.end(), std::begin(rest), std::end(rest));
  EXPECT_EQ(file.content(), expected);
  EXPECT_THAT(write_all(file.path(), "es", {320, 240}, std::vector<Event>{{int64_t{1} << 34, 3, 2, 1}}),
              HasSubstr("shift the times"));
}

TEST(Writers, CsvIsThatOfOpenEb) {
  const TemporaryFile file;
  const std::vector<Event> events = {{-7, 1, 2, 1}, {65, 30, 2, 0}};
  ASSERT_EQ(write_all(file.path(), "csv", {640, 480}, events), "");
  EXPECT_EQ(file.content(), bytes_of("%geometry:640,480\n1,2,1,-7\n30,2,0,65\n"));
}

TEST(Writers, NpyHoldsTheRecordsOfMetavision) {
  const TemporaryFile file;
  const std::vector<Event> events = {{-2, 258, 3, 1}, {int64_t{1} << 40, 4, 515, 0}};
  ASSERT_EQ(write_all(file.path(), "npy", {640, 640}, events), "");
  Bytes content = file.content();
  ASSERT_EQ(content.size(), 192u + 2 * 16);
  const std::string header(content.begin(), content.begin() + 192);
  EXPECT_EQ(header.substr(0, 10), std::string("\x93NUMPY\1\0\xB6\0", 10));
  EXPECT_THAT(header, HasSubstr("[('x', '<u2'), ('y', '<u2'), ('p', '<i2'), ('', '|V2'), ('t', '<i8')]"));
  EXPECT_THAT(header, HasSubstr("'shape': (2,)"));
  EXPECT_EQ(header.back(), '\n');
  content.erase(content.begin(), content.begin() + 192);
  const uint8_t records[] = {2, 1, 3, 0, 1, 0, 0, 0, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                             4, 0, 3, 2, 0, 0, 0, 0, 0,    0,    0,    0,    0,    1,    0,    0};
  EXPECT_EQ(content, Bytes(std::begin(records), std::end(records)));
  EXPECT_THAT(write_all("-", "npy", {640, 480}, {}), HasSubstr("standard output"));
}

TEST(Writers, Evt3UsesVectorsForRowsOfNeighbours) {
  std::vector<Event> row;
  for (uint16_t x = 100; x < 164; ++x) row.push_back({7, x, 9, 1});
  const TemporaryFile file;
  ASSERT_EQ(write_all(file.path(), "evt3", {640, 480}, row), "");
  EXPECT_EQ(
      file.content(),
      with_words<uint16_t>("% evt 3.0\n% format EVT3;height=480;width=640\n% geometry 640x480\n% end\n",
                           {0x8000, 0x6007, 0x0009, 0x3864, 0x4FFF, 0x4FFF, 0x50FF, 0x4FFF, 0x4FFF, 0x50FF}));
}

TEST(Writers, Evt3VectorsAtTheRightEdgeKeepThePolarityApart) {
  // The base behind an OFF vector at the edge of 2048 pixels is 2048: not to be confused with pixel 0, ON.
  std::vector<Event> events;
  for (uint16_t x = 2016; x < 2048; ++x) events.push_back({0, x, 0, 0});
  for (uint16_t x = 0; x < 32; ++x) events.push_back({0, x, 0, 1});
  expect_round_trip("evt3", {2048, 10}, events);
}

TEST(Writers, RefuseWhatTheFormatCannotHold) {
  const SensorSize sensor{3000, 3000};
  const struct {
    Event event;
    const char* reason;
    bool numbers_hold_it;  // text, csv and npy
  } cases[] = {
      {{99, 1, 1, 1}, "sort the events", true},
      {{100, 2048, 0, 1}, "2047", true},
      {{100, 0, 2048, 1}, "2047", true},
      {{100, 3000, 0, 1}, "outside the sensor", false},
      {{100, 0, 3000, 1}, "outside the sensor", false},
      {{100, 0, 0, 2}, "polarity", false},
      {{int64_t{1} << 46, 0, 0, 1}, "shift the times", true},
      {{-1, 0, 0, 1}, "shift the times", true},
      {{int64_t{1} << 62, 0, 0, 1}, "shift the times", false},
      {{-(int64_t{1} << 62), 0, 0, 1}, "shift the times", false},
  };
  for (const std::string_view format : kFormats) {
    for (const auto& c : cases) {
      const TemporaryFile file;
      const std::string error =
          write_all(file.path(), format, sensor, std::vector<Event>{{100, 5, 6, 1}, c.event});
      const bool numbers = format == "text" || format == "csv" || format == "npy";
      const bool large_sensors = format == "dat" || format == "es";
      if (numbers ? c.numbers_hold_it : large_sensors && std::string_view(c.reason) == "2047") {
        EXPECT_EQ(error, "");
      } else {
        EXPECT_THAT(error, AllOf(HasSubstr(file.path()), HasSubstr("event 1 "), HasSubstr(c.reason),
                                 HasSubstr(format)));
      }
    }
  }
  const TemporaryFile file;
  EXPECT_THAT(write_all(file.path(), "evt3", sensor, std::vector<Event>{{int64_t{1} << 36, 0, 0, 1}}),
              HasSubstr("shift the times"));
}

TEST(Writers, CreationErrors) {
  EXPECT_THAT(write_all("/nonexistent/a.raw", "evt2", {640, 480}, {}), HasSubstr("/nonexistent/a.raw"));
  const TemporaryFile file;
  EXPECT_THAT(write_all(file.path(), "evt2", {0, 480}, {}), HasSubstr("0x480"));
  EXPECT_FALSE(std::filesystem::exists(file.path()));
  EXPECT_THAT(write_all("/dev/full", "text", {640, 480}, {}), HasSubstr("cannot write"));
}

TEST(Writers, AFileAppearsWhenItIsFinished) {
  const TemporaryFile file;
  std::filesystem::remove(file.path());
  const std::vector<Event> events = {{1, 2, 3, 1}};
  {
    auto abandoned = *create_events(file.path(), "evt2", {640, 480});
    ASSERT_TRUE(abandoned->write(events).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(file.path()));

  std::ofstream(file.path()) << "earlier";
  {
    auto refused = *create_events(file.path(), "evt2", {640, 480}, {.overwrite = true});
    ASSERT_FALSE(refused->write(std::vector<Event>{{1, 640, 3, 1}}).ok());
  }
  EXPECT_EQ(file.content(), bytes_of("earlier"));

  EXPECT_EQ(write_all(file.path(), "text", {640, 480}, events), "");
  EXPECT_EQ(file.content(), bytes_of("640 480\n0.000001 2 3 1\n"));
}

TEST(Writers, TheHeaderOfTheCameraIsReadAndWritten) {
  const std::string lines =
      "% date 2024-02-03 04:05:06\n% serial_number 00000042\n% system_ID 49\n% plugin_name\n% a b  c\n";
  const TemporaryFile original(bytes_of("% evt 2.0\n" + lines +
                                        "% format EVT2;height=480;width=640\n% Data x\n% geometry 640x480\n"
                                        "% endianness little\n% end\n"));
  const auto source = *open_events(original.path());
  const std::vector<HeaderLine> header(source->header().begin(), source->header().end());
  EXPECT_THAT(header, ElementsAre(HeaderLine{"date", "2024-02-03 04:05:06"},
                                  HeaderLine{"serial_number", "00000042"}, HeaderLine{"system_ID", "49"},
                                  HeaderLine{"plugin_name", ""}, HeaderLine{"a", "b  c"}));
  const std::vector<Event> events = {{65, 3, 2, 1}};
  for (const FormatInfo& format : formats()) {
    if (!format.written) continue;
    const TemporaryFile file;
    auto sink = *create_events(file.path(), format.name, {640, 480}, {.overwrite = true});
    const auto added = sink->write_header(header);
    EXPECT_EQ(added.ok(), format.writes_header) << format.name;
    ASSERT_TRUE(sink->write(events).ok());
    const auto late = sink->write_header(header);
    EXPECT_FALSE(late.ok());
    ASSERT_TRUE(sink->finish().ok());
    if (!format.writes_header) continue;
    EXPECT_EQ(late.error().code, ErrorCode::illegal_parameter);
    const Bytes content = file.content();
    EXPECT_THAT(std::string(content.begin(), content.end()), HasSubstr("\n" + lines + "% end\n"))
        << format.name;
    const auto again = *open_events(file.path());
    EXPECT_EQ(again->format(), format.name);
    EXPECT_EQ(again->sensor(), (SensorSize{640, 480}));
    EXPECT_TRUE(std::vector<HeaderLine>(again->header().begin(), again->header().end()) == header);
  }
}

TEST(Writers, TheHeaderTakesNoLineThatWouldBeReadOtherwise) {
  for (const HeaderLine& line :
       {HeaderLine{"evt", "4.0"}, HeaderLine{"end", ""}, HeaderLine{"geometry", "1x1"},
        HeaderLine{"format", "EVT4"}, HeaderLine{"Width", "3"}, HeaderLine{"a b", "c"},
        HeaderLine{"a", "b\n% end"}, HeaderLine{"a\n", "b"}, HeaderLine{"a", std::string(4096, 'x')}}) {
    const TemporaryFile file;
    auto sink = *create_events(file.path(), "evt3", {640, 480}, {.overwrite = true});
    const auto added = sink->write_header({&line, 1});
    ASSERT_FALSE(added.ok()) << line.key;
    EXPECT_EQ(added.error().code, ErrorCode::bad_input);
  }
}

TEST(Writers, AFinishedSinkRefusesMore) {
  const TemporaryFile file;
  auto sink = create_events(file.path(), "text", {640, 480}, {.overwrite = true});
  ASSERT_TRUE((*sink)->finish().ok());
  EXPECT_FALSE((*sink)->finish().ok());
}

}  // namespace
}  // namespace scarf
