// Known answers of real recordings in packets and bags: AEDAT4, ROS 1, ROS 2, MCAP; and what a cut one gives.
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>

#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using ::testing::HasSubstr;

struct Known {
  const char* path;
  const char* format;
  SensorSize sensor;
  size_t events;
  size_t on;  // 0: not known
};

void PrintTo(const Known& known, std::ostream* out) {
  *out << known.path;
}

std::string data_path(const std::string& path) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  return folder ? std::string(folder) + "/" + path : "";
}

std::string why_skipped(const std::string& format) {
  if (!std::getenv("SCARF_DATA_DIR")) return "SCARF_DATA_DIR is not set";
  for (const FormatInfo& info : formats()) {
    if (info.name == format && !info.missing.empty()) return format + " needs " + info.missing;
  }
  return "";
}

Recording read_file(const std::string& path, const ReadOptions& options = {}) {
  auto source = open_events(path, options);
  if (!source) return {"", std::nullopt, {}, {}, source.error().message};
  return read_all(*std::move(source), 1 << 16);
}

std::string digest_of(const std::vector<Event>& events) {
  EventDigest digest;
  for (const Event& e : events) digest.add(e);
  return digest.hex();
}

class BagsAndPackets : public ::testing::TestWithParam<Known> {};

TEST_P(BagsAndPackets, AreReadAsKnown) {
  const Known& known = GetParam();
  if (const auto why = why_skipped(known.format); !why.empty()) GTEST_SKIP() << why;
  const auto r = read_file(data_path(known.path));
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, known.format);
  EXPECT_EQ(r.sensor, known.sensor);
  EXPECT_EQ(r.events.size(), known.events);
  size_t on = 0;
  for (const Event& e : r.events) on += e.p;
  if (known.on > 0) {
    EXPECT_EQ(on, known.on);
  }
  EXPECT_EQ(r.report.outside + r.report.back_steps + r.report.unknown_words + r.report.truncated_bytes +
                r.report.damages + r.report.gaps,
            0u);
}

INSTANTIATE_TEST_SUITE_P(
    Real, BagsAndPackets,
    ::testing::Values(Known{"aedat/davis346_newtons_cradle.aedat4", "aedat4", {346, 260}, 319'512, 0},
                      Known{"aedat/davis346_short.aedat4", "aedat4", {346, 260}, 117'667, 0},
                      Known{"ros/evt3_events.bag", "rosbag", {640, 480}, 343'474, 125'183},
                      Known{"ros/evt3_events.db3", "rosbag2", {640, 480}, 343'474, 125'183},
                      Known{"ros/hd_evt3_trigger.db3", "rosbag2", {1280, 720}, 82'469, 0},
                      Known{"ros/libcaer_cmp_events.mcap", "mcap", {346, 260}, 571'266, 211'043},
                      Known{"ros/libcaer_rollover.db3", "rosbag2", {640, 480}, 334'331, 0}));

TEST(Bags, OneStreamInTwoKindsOfBagIsTheSame) {
  if (const auto why = why_skipped("rosbag2"); !why.empty()) GTEST_SKIP() << why;
  const auto bag = read_file(data_path("ros/evt3_events.bag"));
  const auto database = read_file(data_path("ros/evt3_events.db3"));
  EXPECT_EQ(digest_of(bag.events), digest_of(database.events));
  int64_t sum = 0;
  for (const Event& e : bag.events) sum += e.t;
  EXPECT_EQ(sum, 2'851'601'611'994);
}

TEST(Bags, TriggersAreThoseKnown) {
  if (const auto why = why_skipped("rosbag"); !why.empty()) GTEST_SKIP() << why;
  auto source = open_triggers(data_path("ros/evt3_events.bag"));
  ASSERT_TRUE(source.ok()) << source.error().message;
  std::array<size_t, 2> edges{};
  std::array<Trigger, 7> some;
  for (;;) {
    const auto count = (*source)->read(some);
    ASSERT_TRUE(count.ok()) << count.error().message;
    if (*count == 0) break;
    for (size_t i = 0; i < *count; ++i) ++edges.at(some[i].value);
  }
  // Bit 0 of the trigger words of the file, counted apart from this reader.
  EXPECT_EQ(edges[0], 2078u);
  EXPECT_EQ(edges[1], 2079u);
}

TEST(Aedat4, FramesAreThoseKnown) {
  if (const auto why = why_skipped("aedat4"); !why.empty()) GTEST_SKIP() << why;
  for (const auto& [path, number] :
       {std::pair{"aedat/davis346_newtons_cradle.aedat4", 13}, std::pair{"aedat/davis346_short.aedat4", 3}}) {
    auto source = open_frames(data_path(path));
    ASSERT_TRUE(source.ok()) << source.error().message;
    int frames = 0;
    int64_t previous = 0;
    for (;;) {
      const auto frame = (*source)->read();
      ASSERT_TRUE(frame.ok()) << frame.error().message;
      if (!*frame) break;
      ++frames;
      EXPECT_EQ((*frame)->image.width, 346);
      EXPECT_EQ((*frame)->image.height, 260);
      EXPECT_GT((*frame)->t, previous);
      previous = (*frame)->t;
    }
    EXPECT_EQ(frames, number);
  }
}

// Cut anywhere, the beginning is read, the place is told, and with strict reading ends there.
TEST(BrokenBagsAndPackets, CutFilesGiveWhatIsWhole) {
  for (const auto& [path, format] :
       {std::pair{"aedat/davis346_newtons_cradle.aedat4", "aedat4"},
        std::pair{"ros/evt3_events.bag", "rosbag"}, std::pair{"ros/libcaer_cmp_events.mcap", "mcap"}}) {
    if (const auto why = why_skipped(format); !why.empty()) GTEST_SKIP() << why;
    std::ifstream file(data_path(path), std::ios::binary);
    Bytes bytes(std::istreambuf_iterator<char>(file), {});
    const auto whole = read_all(bytes);
    EXPECT_EQ(whole.error, "");
    bytes.resize(bytes.size() * 3 / 5);
    const auto cut = read_all(dripping(bytes, 10'007));
    EXPECT_EQ(cut.error, "");
    EXPECT_GT(cut.events.size(), 0u) << path;
    EXPECT_LT(cut.events.size(), whole.events.size());
    EXPECT_TRUE(std::equal(cut.events.begin(), cut.events.end(), whole.events.begin()));
    EXPECT_EQ(cut.report.damages, 1u);
    EXPECT_GT(cut.report.truncated_bytes, 0u);
    ReadOptions strict;
    strict.strict = true;
    EXPECT_THAT(read_all(bytes, strict).error, HasSubstr("byte "));
  }
}

// Any byte may be wrong: never a crash, and reading ends.
TEST(BrokenBagsAndPackets, DamagedFilesAreReadToTheirEnd) {
  std::mt19937 random(11);
  for (const char* path :
       {"aedat/davis346_short.aedat4", "ros/evt3_events.bag", "ros/libcaer_cmp_events.mcap"}) {
    if (!std::getenv("SCARF_DATA_DIR")) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
    std::ifstream file(data_path(path), std::ios::binary);
    Bytes original(std::istreambuf_iterator<char>(file), {});
    original.resize(std::min<size_t>(original.size(), 300'000));
    for (int i = 0; i < 10; ++i) {
      Bytes bytes = original;
      for (int k = 0; k < 40; ++k) bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
      const auto r = read_all(bytes);
      EXPECT_EQ(r.report.events, r.events.size());
    }
  }
}

}  // namespace
}  // namespace scarf
