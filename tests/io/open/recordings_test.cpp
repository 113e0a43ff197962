// Known answers of real recordings, found through the environment variable SCARF_DATA_DIR.
#include <cstdlib>

#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

struct Known {
  const char* path;
  const char* format;
  SensorSize sensor;
  size_t events;
  size_t on;
  Event first;
  Event last;
  const char* digest;
};

void PrintTo(const Known& known, std::ostream* out) {
  *out << known.path;
}

class Recordings : public ::testing::TestWithParam<Known> {};

TEST_P(Recordings, AreReadAsKnown) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  const Known& known = GetParam();
  for (const size_t batch : {size_t{1}, size_t{1} << 20}) {
    auto source = open_events(std::string(folder) + "/" + known.path);
    ASSERT_TRUE(source.ok()) << source.error().message;
    const auto r = read_all(*std::move(source), batch);
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, known.format);
    EXPECT_EQ(r.sensor, known.sensor);
    ASSERT_EQ(r.events.size(), known.events);
    EXPECT_EQ(r.events.front(), known.first);
    EXPECT_EQ(r.events.back(), known.last);
    size_t on = 0;
    EventDigest digest;
    for (const Event& e : r.events) {
      on += e.p;
      digest.add(e);
    }
    EXPECT_EQ(on, known.on);
    EXPECT_EQ(digest.hex(), known.digest);
    EXPECT_EQ(r.report.events, known.events);
    EXPECT_EQ(r.report.outside + r.report.back_steps + r.report.unknown_words + r.report.truncated_bytes, 0u);
  }
}

TEST_P(Recordings, ComeBackFromEveryWriter) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  auto source = open_events(std::string(folder) + "/" + GetParam().path);
  ASSERT_TRUE(source.ok()) << source.error().message;
  const auto original = read_all(*std::move(source), 1 << 16);
  for (const char* format : {"dat", "evt2", "evt21", "evt3", "evt4", "es", "npy", "csv", "text"}) {
    const TemporaryFile file;
    auto sink = create_events(file.path(), format, GetParam().sensor, {.overwrite = true});
    ASSERT_TRUE(sink.ok()) << sink.error().message;
    ASSERT_TRUE((*sink)->write(original.events).ok());
    ASSERT_TRUE((*sink)->finish().ok());
    auto written = open_events(file.path());
    ASSERT_TRUE(written.ok()) << written.error().message;
    EXPECT_TRUE(read_all(*std::move(written), 1 << 16).events == original.events);
  }
}

// DAT of the N-CARS set, which does not say its sensor size.
TEST(Dat, NCarsIsReadAsKnown) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  auto source = open_events(std::string(folder) + "/misc/ncars.dat");
  ASSERT_TRUE(source.ok()) << source.error().message;
  const auto r = read_all(*std::move(source), 100);
  EXPECT_EQ(r.format, "dat");
  EXPECT_EQ(r.sensor, std::nullopt);
  ASSERT_EQ(r.events.size(), 2009u);
  EXPECT_EQ(r.events.front(), (Event{0, 25, 8, 0}));
  EXPECT_EQ(r.events.back(), (Event{99'952, 75, 28, 1}));
  EventDigest digest;
  size_t on = 0;
  for (const Event& e : r.events) {
    digest.add(e);
    on += e.p;
  }
  EXPECT_EQ(on, 1350u);
  EXPECT_EQ(digest.hex(), "ad3600a8858f0dd69ff8452b20dff06d65edf147a5373f72066b84f262abda82");
}

// Recordings of which the number of events is known, with the options that they need.
struct Counted {
  const char* label;
  const char* path;
  const char* format;
  std::optional<SensorSize> sensor;  // of the file
  ReadOptions options;
  size_t events;
};

void PrintTo(const Counted& counted, std::ostream* out) {
  *out << counted.label;
}

class CountedRecordings : public ::testing::TestWithParam<Counted> {};

TEST_P(CountedRecordings, AreReadWhole) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  const Counted& counted = GetParam();
  const bool zip = counted.format == std::string_view("ecd") || counted.format == std::string_view("npz");
  if (const auto missing = missing_library("npz"); zip && !missing.empty()) GTEST_SKIP() << missing;
  auto source = open_events(std::string(folder) + "/" + counted.path, counted.options);
  ASSERT_TRUE(source.ok()) << source.error().message;
  const auto r = read_all(*std::move(source), 1 << 16);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, counted.format);
  EXPECT_EQ(r.sensor, counted.sensor);
  EXPECT_EQ(r.events.size(), counted.events);
  EXPECT_EQ(r.report.unknown_words + r.report.truncated_bytes + r.report.damages, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Real, CountedRecordings,
    ::testing::Values(
        Counted{"camera_shake", "frames/camerashake.zip", "ecd", SensorSize{240, 180}, {}, 7'213'245},
        Counted{"slider_depth", "frames/slider_depth_50k.zip", "ecd", SensorSize{240, 180}, {}, 50'000},
        Counted{"bouncing_ball", "yarp/bouncing_ball", "yarp", std::nullopt, {}, 32'532},
        Counted{"nmnist", "misc/nmnist.bin", "nmnist", std::nullopt, read_options("", "", "", "nmnist"),
                4'325},
        Counted{"pendulum_left", "misc/pendulum_stereo.npz", "npz", std::nullopt, read_options("left"),
                141'252},
        Counted{"pendulum_right", "misc/pendulum_stereo.npz", "npz", std::nullopt, read_options("right"),
                261'307},
        Counted{"box_left", "stereo/box1.txt", "text", std::nullopt, read_options("0", "txypc_", "us"),
                40'058},
        Counted{"box_right", "stereo/box1.txt", "text", std::nullopt, read_options("1", "txypc_", "us"),
                57'121}),
    [](const auto& test) { return std::string(test.param.label); });

TEST(Ecd, FramesAreThoseKnown) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  if (const auto missing = missing_library("npz"); !missing.empty()) GTEST_SKIP() << missing;
  const std::pair<const char*, int> files[] = {{"frames/camerashake.zip", 85},
                                               {"frames/slider_depth_50k.zip", 6}};
  for (const auto& [path, number] : files) {
    auto source = open_frames(std::string(folder) + "/" + path);
    ASSERT_TRUE(source.ok()) << source.error().message;
    int frames = 0;
    int64_t previous = -1;
    for (;; ++frames) {
      const auto frame = (*source)->read();
      ASSERT_TRUE(frame.ok()) << frame.error().message;
      if (!*frame) break;
      EXPECT_EQ((*frame)->image.width, 240);
      EXPECT_EQ((*frame)->image.height, 180);
      EXPECT_GT((*frame)->t, previous);
      previous = (*frame)->t;
    }
    EXPECT_EQ(frames, number);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Raw, Recordings,
    ::testing::Values(Known{"raw/hd_evt3_driving.raw",
                            "evt3",
                            {1280, 720},
                            219'596,
                            115'532,
                            {11'718'656, 874, 200, 0},
                            {11'727'457, 1218, 572, 1},
                            "9bba5ca48301878102200069a89413a3240eaae3ff599d217f1c1a84d13fe7ba"},
                      Known{"raw/vga_evt2_sparks.raw",
                            "evt2",
                            {640, 480},
                            521'252,
                            185'861,
                            {913'716'224, 35, 443, 1},
                            {913'812'095, 12, 471, 0},
                            "58773c06cd3098d13e0f2781e1134449d2f01ed498d4975aabc2c4e5ec81d44b"},
                      Known{"es/dvs.es",
                            "es",
                            {320, 240},
                            473'225,
                            270'001,
                            {0, 0, 0, 1},
                            {999'000, 38, 193, 1},
                            "0e8b5a168fd6f024136faf24807558bec5ed65ebd3300b2712c1e2944fd69f4c"},
                      Known{"aedat/davis240_boxes_aedat2.aedat",
                            "aedat2",
                            {240, 180},
                            162'771,
                            82'944,
                            {294'976'755, 83, 143, 0},
                            {297'049'406, 6, 139, 0},
                            "417ddf2f4147444a7fb285d0064f684d4807e107c01663819b4976834c6eea8e"}),
    [](const auto& test) { return std::string(test.param.format); });

}  // namespace
}  // namespace scarf
