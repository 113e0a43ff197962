// Every layout of HDF5, out of files that h5py writes: real events, re-encoded.
#include <gmock/gmock.h>
#include <unistd.h>

#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"
#include "tests/io/hdf5/hdf5_test_helpers.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr SensorSize kSensor{1280, 720};
constexpr int64_t kUnixTime = 1'506'117'899'000'000;

std::string digest_of(const std::vector<Event>& events) {
  EventDigest digest;
  for (const Event& e : events) digest.add(e);
  return digest.hex();
}

class Hdf5 : public Hdf5Test {
 protected:
  void expect_same(const Recording& r, const char* format) {
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, format);
    EXPECT_EQ(r.sensor, kSensor);
    EXPECT_EQ(r.events.size(), events.size());
    EXPECT_EQ(digest_of(r.events), digest_of(events));
    EXPECT_EQ(r.report.damages, 0u);
  }
  std::vector<Event> mirrored() const {
    std::vector<Event> right = events;
    for (Event& e : right) e.x = static_cast<uint16_t>(1279 - e.x);
    return right;
  }
};

TEST_F(Hdf5, Metavision) {
  if (!make({"metavision-ecf", "metavision-gzip", "metavision-plain"})) GTEST_SKIP() << kMissing;
  expect_same(read("metavision-ecf"), "metavision-h5");
  expect_same(read("metavision-gzip"), "metavision-h5");
  expect_same(read("metavision-plain"), "metavision-h5");
}

TEST_F(Hdf5, Dsec) {
  if (!make({"dsec-gzip"})) GTEST_SKIP() << kMissing;
  expect_same(read("dsec-gzip", {kSensor}), "dsec");
}

TEST_F(Hdf5, DsecWithBlosc) {
  if (!make({"dsec-blosc"})) GTEST_SKIP() << kMissing;
  expect_same(read("dsec-blosc", {kSensor}), "dsec");
}

TEST_F(Hdf5, DsecWithLz4) {
  if (!make({"dsec-lz4"})) GTEST_SKIP() << kMissing;
  expect_same(read("dsec-lz4", {kSensor}), "dsec");
}

TEST_F(Hdf5, Rvt) {
  if (!make({"rvt"})) GTEST_SKIP() << kMissing;
  expect_same(read("rvt"), "rvt");
}

TEST_F(Hdf5, M3edAndItsStreams) {
  if (!make({"m3ed"})) GTEST_SKIP() << kMissing;
  expect_same(read("m3ed", {.sensor = {}, .stream = "left"}), "m3ed");
  EXPECT_EQ(digest_of(read("m3ed", {.sensor = {}, .stream = "right"}).events), digest_of(mirrored()));
  EXPECT_THAT(read("m3ed").error, AllOf(HasSubstr("ReadOptions::stream"), HasSubstr("left, right")));
  EXPECT_THAT(read("m3ed", {.sensor = {}, .stream = "middle"}).error,
              AllOf(HasSubstr("middle"), HasSubstr("left, right")));
}

TEST_F(Hdf5, MvsecInUnixSeconds) {
  if (!make({"mvsec"})) GTEST_SKIP() << kMissing;
  auto left = read("mvsec", {.sensor = {}, .stream = "left"});
  for (Event& e : left.events) e.t -= kUnixTime;
  expect_same(left, "mvsec");
}

TEST_F(Hdf5, MvsecFrames) {
  if (!make({"mvsec"})) GTEST_SKIP() << kMissing;
  auto frames = open_frames(path("mvsec.h5"), {.sensor = {}, .stream = "right"});
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  for (const int64_t t : {1, 250'000, 1'999'999}) {
    const auto frame = (*frames)->read();
    ASSERT_TRUE(frame.ok() && frame->has_value());
    EXPECT_EQ((*frame)->t, kUnixTime + t);
    EXPECT_EQ((*frame)->image.width, 1280);
    EXPECT_EQ((*frame)->image.height, 720);
    if (t == 1) {
      EXPECT_EQ((*frame)->image.at(1279, 1), 2559 % 251 + 1);
    }
  }
  const auto end = (*frames)->read();
  ASSERT_TRUE(end.ok());
  EXPECT_FALSE(end->has_value());
  EXPECT_THAT(open_frames(path("mvsec.h5")).error().message, HasSubstr("left, right"));
}

TEST_F(Hdf5, EventUtils) {
  if (!make({"event-utils"})) GTEST_SKIP() << kMissing;
  expect_same(read("event-utils"), "event-utils");
}

TEST_F(Hdf5, OtherColumnsRecordsAndArrays) {
  if (!make({"columns-big-endian", "records", "array-integers", "array-milliseconds"}))
    GTEST_SKIP() << kMissing;
  expect_same(read("columns-big-endian", {kSensor}), "hdf5");
  expect_same(read("records", {kSensor}), "hdf5");
  expect_same(read("array-integers", {.sensor = kSensor, .columns = "txyp"}), "hdf5");
  expect_same(read("array-milliseconds", {.sensor = kSensor, .columns = "xypt", .time_unit = "ms"}), "hdf5");
  EXPECT_THAT(read("array-integers").error, HasSubstr("ReadOptions::columns"));
  EXPECT_THAT(read("array-integers", {.sensor = {}, .columns = "txy"}).error, HasSubstr("txy"));
  EXPECT_THAT(read("array-integers", {.sensor = {}, .columns = "txyx"}).error, HasSubstr("txyx"));
  EXPECT_THAT(read("array-milliseconds", {.sensor = {}, .columns = "xypt"}).error,
              HasSubstr("ReadOptions::time_unit"));
  EXPECT_THAT(read("records", {.sensor = {}, .columns = "xypt"}).error, HasSubstr("ReadOptions::columns"));
}

TEST_F(Hdf5, NamesOfOtherToolsInAnyGroup) {
  for (const char* layout :
       {"names-dv", "names-loris", "names-upper", "names-plural-deep", "names-faery", "names-dv-records",
        "names-loris-records", "names-upper-records", "names-plural-deep-records", "names-faery-records"}) {
    if (!make({layout})) GTEST_SKIP() << kMissing;
    SCOPED_TRACE(layout);
    expect_same(read(layout, {kSensor}), "hdf5");
  }
}

TEST_F(Hdf5, ANameMaySayTheUnitOfTimes) {
  if (!make({"nanoseconds"})) GTEST_SKIP() << kMissing;
  expect_same(read("nanoseconds", {kSensor}), "hdf5");  // from half a microsecond before on
}

TEST_F(Hdf5, SeveralTablesAreListed) {
  if (!make({"two-tables"})) GTEST_SKIP() << kMissing;
  EXPECT_THAT(read("two-tables").error,
              AllOf(HasSubstr("ReadOptions::stream"), HasSubstr("/left"), HasSubstr("/right")));
  expect_same(read("two-tables", {.sensor = {}, .stream = "/left"}), "hdf5");
  EXPECT_EQ(read("two-tables", {.sensor = {}, .stream = "/right"}).events.front(), events.back());
  EXPECT_THAT(read("two-tables", {.sensor = {}, .stream = "/middle"}).error, HasSubstr("/left"));
}

TEST_F(Hdf5, ColumnsAreNamedWhereTheirNamesSayNothing) {
  if (!make({"foreign-names", "names-dv"})) GTEST_SKIP() << kMissing;
  const auto named = [&](const std::string& columns, const std::string& stream = "") {
    return read("foreign-names", {.sensor = kSensor, .stream = stream, .columns = columns});
  };
  expect_same(named("t=/a/when,x=/a/where[0],y=/a/where[1],p=/b/sign/up"), "hdf5");
  expect_same(named("p=b/sign/down,t=a/when,y=a/where[1],x=a/where[0]"), "hdf5");
  EXPECT_THAT(named("").error, AllOf(HasSubstr("no events"), HasSubstr("/a/when"), HasSubstr("/b/sign/up"),
                                     HasSubstr("ReadOptions::columns")));
  EXPECT_THAT(named("t=/a/wann,x=/a/where[0],y=/a/where[1],p=/b/sign/up").error,
              AllOf(HasSubstr("/a/wann"), HasSubstr("/a/when")));
  EXPECT_THAT(named("t=/a/when,x=/a/where,y=/a/where[1],p=/b/sign/up").error, HasSubstr("/a/where"));
  EXPECT_THAT(named("t=/a/when,x=/a/where[2],y=/a/where[1],p=/b/sign/up").error, HasSubstr("2 columns"));
  EXPECT_THAT(named("t=/a/when,x=/a/where[0],y=/a/where[1],p=/b/sign/left").error, HasSubstr("left"));
  EXPECT_THAT(named("t=/a/when,x=/a/where[0],y=/a/where[1],p=/b/sign").error, HasSubstr("member"));
  EXPECT_THAT(named("t=/a/when,x=/a/where[0],y=/a/where[1]").error, HasSubstr("each of t, x, y and p"));
  EXPECT_THAT(named("t=/a/when,x=/a/where[0],y=/a/where[1],p=/b/sign/up", "/a").error,
              HasSubstr("ReadOptions::stream"));
  // Also in place of those that have names.
  const auto swapped =
      read("names-dv", {.sensor = SensorSize{720, 1280},
                        .columns = "t=/events/timestamp,x=/events/y,y=/events/x,p=/events/polarity"});
  ASSERT_EQ(swapped.events.size(), events.size());
  EXPECT_EQ(swapped.events.front().x, events.front().y);
}

TEST_F(Hdf5, TablesOfMatlab) {
  if (!make({"matlab-struct", "matlab-vectors", "matlab-matrix", "matlab-square"})) GTEST_SKIP() << kMissing;
  const auto us = [](const std::string& columns) {
    return ReadOptions{.sensor = kSensor, .columns = columns, .time_unit = "us"};
  };
  expect_same(read("matlab-struct", us("")), "hdf5");
  expect_same(read("matlab-vectors", us("")), "hdf5");
  expect_same(read("matlab-matrix", us("xytp")), "hdf5");
  expect_same(read("matlab-matrix", us("t=/TD[2],x=/TD[0],y=/TD[1],p=/TD[3]")), "hdf5");
  const auto square = read("matlab-square", us("xytp"));
  EXPECT_EQ(square.events, std::vector<Event>(events.begin(), events.begin() + 4));
  EXPECT_THAT(read("matlab-matrix").error,
              AllOf(HasSubstr("no events"), HasSubstr("/TD"), HasSubstr("ReadOptions::columns")));
  EXPECT_THAT(read("matlab-struct").error, HasSubstr("ReadOptions::time_unit")) << "doubles that are whole";
}

TEST_F(Hdf5, WholeDoublesMayBeSecondsOrMicroseconds) {
  if (!make({"whole-doubles"})) GTEST_SKIP() << kMissing;
  EXPECT_THAT(read("whole-doubles").error, HasSubstr("ReadOptions::time_unit"));
  expect_same(read("whole-doubles", {.sensor = kSensor, .time_unit = "us"}), "hdf5");
}

TEST_F(Hdf5, ValuesThatNoEventHoldsAreCounted) {
  if (!make({"odd-values"})) GTEST_SKIP() << kMissing;
  const auto r = read("odd-values");
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.events, (std::vector<Event>{{1, 1, 1, 1}, {3, 3, 3, 0}, {3, 5, 5, 1}}))
      << "times to the nearest microsecond, halves up";
  EXPECT_EQ(r.report.outside, 2u);
  EXPECT_EQ(r.report.unknown_words, 1u);
  EXPECT_EQ(r.report.back_steps, 1u);
  EXPECT_EQ(r.report.largest_back_step, 1) << "against the event before it, outside or not";
  EXPECT_THAT(read("odd-values", {.sensor = {}, .strict = true}).error, HasSubstr("row 2"));
}

// Events of a polarity that is none are counted, whatever the layout, and never taken for bright ones.
TEST_F(Hdf5, PolaritiesThatTheFormatDoesNotDefineAreCounted) {
  std::vector<Event> defined;
  for (size_t i = 0; i < events.size(); ++i) {
    if (i % 1000 == 0) events[i].p = i % 2000 == 0 ? 2 : 7;
    if (i % 1000 != 0) defined.push_back(events[i]);
  }
  const uint64_t undefined = events.size() - defined.size();
  write_events(events);
  for (const std::string layout : {"metavision-plain", "dsec-gzip", "rvt", "m3ed", "mvsec",
                                   "columns-big-endian", "records", "array-integers"}) {
    SCOPED_TRACE(layout);
    if (!make({layout.c_str()})) GTEST_SKIP() << kMissing;
    ReadOptions options;
    if (layout == "m3ed" || layout == "mvsec") options.stream = "left";
    if (layout == "array-integers") options.columns = "txyp";
    auto r = read(layout, options);
    if (layout == "mvsec") {
      for (Event& e : r.events) e.t -= kUnixTime;
    }
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(digest_of(r.events), digest_of(defined));
    EXPECT_EQ(r.report.undefined_polarities, undefined);
    EXPECT_EQ(r.report.unknown_words, 0u);
    options.strict = true;
    EXPECT_THAT(read(layout, options).error, AllOf(HasSubstr("row 0"), HasSubstr("polarity")));
  }
}

TEST_F(Hdf5, PolaritiesOfEveryTypeOfNumber) {
  const struct {
    const char* layout;
    std::vector<uint8_t> p;
    uint64_t undefined;
  } cases[] = {{"polarities-u1-0,1,255,2", {0, 1}, 2},
               {"polarities-i1-0,1,-1,2,-3", {0, 1, 0}, 2},
               {"polarities-u2-1,65535", {1}, 1},
               {"polarities-u4-1,4294967295", {1}, 1},
               {"polarities-u8-1,9e18", {1}, 1},
               {"polarities-f4-0,0.5,1,-1,1.5", {0, 1, 0}, 2},
               {"polarities-f8-nan,1,inf,-0.25,0", {1, 0}, 3},
               {"polarities-bool-0,1", {0, 1}, 0}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.layout);
    if (!make({c.layout})) GTEST_SKIP() << kMissing;
    const auto r = read(c.layout);
    EXPECT_EQ(r.error, "");
    std::vector<uint8_t> p;
    for (const Event& e : r.events) p.push_back(e.p);
    EXPECT_EQ(p, c.p);
    EXPECT_EQ(r.report.undefined_polarities, c.undefined);
  }
}

TEST_F(Hdf5, ABrokenChunkCostsItsRowsAlone) {
  if (!make({"metavision-broken", "dsec-broken"})) GTEST_SKIP() << kMissing;
  for (const auto& [layout, first, last] :
       {std::tuple("metavision-broken", 16'384, 32'768), std::tuple("dsec-broken", 10'000, 20'000)}) {
    std::vector<Event> rest = events;
    rest.erase(rest.begin() + first, rest.begin() + last);
    const auto r = read(layout);
    EXPECT_EQ(r.error, "") << layout;
    EXPECT_EQ(r.events, rest) << layout;
    EXPECT_EQ(r.report.damages, 1u) << layout;
    ASSERT_TRUE(r.report.damage.has_value());
    EXPECT_GT(r.report.damage->byte, 0u);
    EXPECT_LT(r.report.damage->byte, std::filesystem::file_size(path(std::string(layout) + ".h5")));
    EXPECT_THAT(r.report.damage->what,
                HasSubstr("rows " + std::to_string(first) + " to " + std::to_string(last - 1)));
    EXPECT_THAT(read(layout, {.sensor = {}, .strict = true}).error,
                AllOf(HasSubstr("ReadOptions::strict"), HasSubstr("byte "), HasSubstr(layout)));
  }
}

TEST_F(Hdf5, ColumnsOfDifferentLengthAreReadUpToTheShortest) {
  if (!make({"dsec-shorter"})) GTEST_SKIP() << kMissing;
  const auto r = read("dsec-shorter");
  EXPECT_EQ(r.events.size(), events.size() - 5);
  EXPECT_EQ(r.report.damages, 1u);
  EXPECT_THAT(r.report.damage->what, HasSubstr("events/y has " + std::to_string(events.size() - 5)));
}

TEST_F(Hdf5, WhatWasNeverWrittenIsNoEvent) {
  if (!make({"hole"})) GTEST_SKIP() << kMissing;
  const auto r = read("hole");
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.events.size(), 1024u);
  EXPECT_GT(r.report.damages, 1u);
}

TEST_F(Hdf5, RefusesWhatItMustNotRead) {
  if (!make({"huge-chunk", "external", "external-link", "zstd", "no-events", "rvt"}))
    GTEST_SKIP() << kMissing;
  EXPECT_THAT(read("huge-chunk").error, AllOf(HasSubstr("chunks of more than"), HasSubstr("h5repack")));
  EXPECT_THAT(read("external").error, HasSubstr("other files"));
  EXPECT_THAT(read("external-link").error, HasSubstr("no events"));
  if (!make({"virtual", "virtual-unlimited", "virtual-size"})) GTEST_SKIP() << kMissing;
  alarm(60);  // who opens the pipe that they name waits for ever
  EXPECT_THAT(read("virtual").error, HasSubstr("other files"));
  EXPECT_THAT(read("virtual-unlimited").error, HasSubstr("other files"));
  EXPECT_EQ(read("virtual-size").sensor, std::nullopt) << "a width that lies elsewhere is none";
  alarm(0);
  EXPECT_THAT(read("zstd").error, AllOf(HasSubstr("Zstandard"), HasSubstr("32015"), HasSubstr("events/x")));
  const std::string error = read("no-events").error;
  EXPECT_THAT(error, AllOf(HasSubstr("no-events.h5"), HasSubstr("no events"), Not(HasSubstr("\n"))));
  EXPECT_EQ(open_events(path("no-events.h5")).error().code, ErrorCode::unrecognised);
  EXPECT_EQ(open_events(path("no-events.h5"), {.sensor = {}, .format = "dsec"}).error().code,
            ErrorCode::bad_input);
  EXPECT_THAT(read("rvt", {.sensor = {}, .format = "mvsec"}).error, HasSubstr("mvsec"));
  EXPECT_THAT(read("rvt", {SensorSize{640, 480}}).error, AllOf(HasSubstr("1280x720"), HasSubstr("640x480")));
}

TEST_F(Hdf5, ACutFileIsAnErrorThatNamesIt) {
  if (!make({"rvt"})) GTEST_SKIP() << kMissing;
  std::filesystem::resize_file(path("rvt.h5"), std::filesystem::file_size(path("rvt.h5")) / 2);
  EXPECT_THAT(read("rvt").error, AllOf(HasSubstr("rvt.h5"), HasSubstr("truncated"), Not(HasSubstr("\n"))));
}

TEST_F(Hdf5, APipeIsRefused) {
  const auto bytes = bytes_of("\x89HDF\r\n\x1a\n");
  EXPECT_THAT(read_all(bytes).error, HasSubstr("pipe"));
}

}  // namespace
}  // namespace scarf
