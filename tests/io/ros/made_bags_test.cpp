// Bags, MCAP and AEDAT4 that a Python script writes from the formats' descriptions: what was written is read.
#include <gmock/gmock.h>

#include <array>

#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"
#include "tests/io/python_recordings.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr SensorSize kSensor{346, 260};
constexpr int64_t kUnixTime = 1'700'000'000'999'000;

std::vector<Event> some_events() {
  std::mt19937 random(3);
  std::vector<Event> events;
  for (int64_t t = kUnixTime; events.size() < 500; t += static_cast<int64_t>(random() % 40)) {
    events.push_back({t, static_cast<uint16_t>(random() % 346), static_cast<uint16_t>(random() % 260),
                      static_cast<uint8_t>(random() % 2)});
  }
  return events;
}

class MadeBags : public PythonRecordings {
 protected:
  MadeBags() { write_events(events); }

  /// Writes a recording of this kind. False: a library of ours or a Python module is missing.
  bool make(const std::string& kind, const std::string& format) const {
    for (const FormatInfo& info : formats()) {
      if (info.name == format && !info.missing.empty()) return false;
    }
    const int exit_code = python(SCARF_MAKE_BAGS, kind, path(kind));
    if (exit_code == kModuleMissing) return false;
    EXPECT_EQ(exit_code, 0) << kind;
    return true;
  }
  static constexpr const char* kMissing = "python3-lz4, python3-zstandard or a library is not installed";

  Recording read(const std::string& kind, const ReadOptions& options = {}) const {
    return read_path(path(kind), options, 77);
  }

  void expect_written(const Recording& r, const std::string& format) const {
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, format);
    EXPECT_EQ(r.sensor, kSensor);
    EXPECT_EQ(r.events, events);
    EXPECT_EQ(r.report.damages + r.report.gaps + r.report.truncated_bytes + r.report.unknown_words, 0u);
  }

  std::vector<Trigger> triggers(const std::string& kind) const {
    const auto source = open_triggers(path(kind));
    EXPECT_TRUE(source.ok()) << source.error().message;
    std::vector<Trigger> all;
    std::array<Trigger, 2> some;
    for (;;) {
      const auto count = (*source)->read(some);
      EXPECT_TRUE(count.ok());
      if (!count || *count == 0) return all;
      all.insert(all.end(), some.begin(), some.begin() + static_cast<ptrdiff_t>(*count));
    }
  }

  const std::vector<Event> events = some_events();
};

TEST_F(MadeBags, Ros1WithoutCompression) {
  if (!make("rosbag-dvs-none", "rosbag")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag-dvs-none"), "rosbag");
}

TEST_F(MadeBags, Ros1WithBzip2AndMessagesOfProphesee) {
  if (!make("rosbag-prophesee-bz2", "rosbag")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag-prophesee-bz2"), "rosbag");
}

TEST_F(MadeBags, Ros1WithLz4) {
  if (!make("rosbag-dvs-lz4", "rosbag")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag-dvs-lz4"), "rosbag");
}

TEST_F(MadeBags, Ros1WithoutAnIndex) {
  if (!make("rosbag-dvs-none-unindexed", "rosbag")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag-dvs-none-unindexed"), "rosbag");
}

TEST_F(MadeBags, Ros2FolderOfBigEndianArraysInTheOrderOfItsMetadata) {
  if (!make("rosbag2-folder", "rosbag2")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag2-folder"), "rosbag2");
}

TEST_F(MadeBags, Ros2CompressedByMessageOrByFile) {
  for (const std::string kind : {"rosbag2-folder-db3-MESSAGE", "rosbag2-folder-db3-FILE",
                                 "rosbag2-folder-mcap-MESSAGE", "rosbag2-folder-mcap-FILE"}) {
    if (!make(kind, "rosbag2")) GTEST_SKIP() << kMissing;
    expect_written(read(kind), "rosbag2");
  }
  // One file of either by itself.
  const auto part = [&](const std::string& name) { return read_path(path(name), {}, 77); };
  const std::vector<Event> first(events.begin(), events.begin() + 300);
  EXPECT_EQ(part("rosbag2-folder-db3-MESSAGE/z_0.db3").events, first);
  EXPECT_EQ(part("rosbag2-folder-db3-FILE/z_0.db3.zstd").events, first);
  EXPECT_EQ(part("rosbag2-folder-mcap-FILE/z_0.mcap.zstd").events, first);
  EXPECT_EQ(part("rosbag2-folder-mcap-MESSAGE/z_0.mcap").events, first);
}

TEST_F(MadeBags, Ros2CompressedBagsThatAreBroken) {
  const std::string folder = "rosbag2-folder-db3-FILE";
  if (!make(folder, "rosbag2")) GTEST_SKIP() << kMissing;
  const std::string packed = path(folder + "/z_0.db3.zstd");
  std::filesystem::resize_file(packed, std::filesystem::file_size(packed) / 2);
  EXPECT_THAT(read(folder).error, AllOf(HasSubstr("z_0.db3.zstd"), HasSubstr("compressed bytes")));

  // A bomb: far too much of nothing.
  ASSERT_TRUE(make("zstd-bomb", "rosbag2"));
  EXPECT_THAT(read("zstd-bomb").error, HasSubstr("1000 times its size"));
}

TEST_F(MadeBags, Ros2DatabaseOfBigEndianMessages) {
  if (!make("rosbag2-mono", "rosbag2")) GTEST_SKIP() << kMissing;
  expect_written(read("rosbag2-mono"), "rosbag2");
}

TEST_F(MadeBags, McapWithEveryCompression) {
  for (const std::string kind : {"mcap", "mcap-lz4", "mcap-zstd"}) {
    if (!make(kind, "mcap")) GTEST_SKIP() << kMissing;
    expect_written(read(kind), "mcap");
  }
}

TEST_F(MadeBags, McapWithTriggersOnATopicOfTheirOwn) {
  if (!make("mcap", "mcap")) GTEST_SKIP() << kMissing;
  const auto found = triggers("mcap");
  ASSERT_EQ(found.size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    const Trigger expected{events[100 * i].t, static_cast<uint16_t>(100 * i % 3),
                           static_cast<uint8_t>(i % 2)};
    EXPECT_EQ(found[i], expected) << i;
  }
}

TEST_F(MadeBags, Aedat4WithEveryCompression) {
  for (const std::string kind : {"aedat4-none-1", "aedat4-lz4-1", "aedat4-zstd-1"}) {
    if (!make(kind, "aedat4")) GTEST_SKIP() << kMissing;
    expect_written(read(kind), "aedat4");
  }
}

// A boolean is a byte in these formats, and has two values.
TEST_F(MadeBags, PolaritiesThatAreNoBooleansAreCounted) {
  std::vector<Event> odd = events;
  odd[3].p = 2;
  odd[100].p = 255;
  std::vector<Event> defined = events;
  defined.erase(defined.begin() + 100);
  defined.erase(defined.begin() + 3);
  write_events(odd);
  for (const auto& [kind, format] :
       {std::pair{"rosbag-dvs-none", "rosbag"}, std::pair{"rosbag2-folder", "rosbag2"},
        std::pair{"aedat4-none-1", "aedat4"}}) {
    SCOPED_TRACE(kind);
    if (!make(kind, format)) GTEST_SKIP() << kMissing;
    const auto r = read(kind);
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.events, defined);
    EXPECT_EQ(r.report.undefined_polarities, 2u);
    EXPECT_THAT(read(kind, {.sensor = {}, .strict = true}).error,
                AllOf(HasSubstr("byte "), HasSubstr("polarity")));
  }
}

TEST_F(MadeBags, Aedat4WithTwoCameras) {
  if (!make("aedat4-zstd-2", "aedat4")) GTEST_SKIP() << kMissing;
  EXPECT_THAT(read("aedat4-zstd-2").error,
              AllOf(HasSubstr("ReadOptions::stream"), HasSubstr("0 (346x260 from CAMERA0)"),
                    HasSubstr("1 (346x260 from CAMERA1)")));
  expect_written(read("aedat4-zstd-2", {.sensor = {}, .stream = "0"}), "aedat4");
  auto second = read("aedat4-zstd-2", {.sensor = {}, .stream = "1"});
  for (Event& e : second.events) e.x = static_cast<uint16_t>(345 - e.x);
  expect_written(second, "aedat4");
}

TEST_F(MadeBags, Aedat4FramesInGreyAndColour) {
  if (!make("aedat4-none-1", "aedat4")) GTEST_SKIP() << kMissing;
  auto source = open_frames(path("aedat4-none-1"));
  ASSERT_TRUE(source.ok()) << source.error().message;
  for (int number = 0; number < 2; ++number) {
    const auto frame = (*source)->read();
    ASSERT_TRUE(frame.ok() && *frame);
    EXPECT_EQ((*frame)->t, kUnixTime + 1000 * number);
    EXPECT_EQ((*frame)->exposure_begin, (*frame)->t - 300);
    EXPECT_EQ((*frame)->exposure_end, (*frame)->t + 300);
    ASSERT_EQ((*frame)->image.width, 8);
    ASSERT_EQ((*frame)->image.height, 6);
    for (int i = 0; i < 48; ++i) {
      // Colours 3i, 3i + 1, 3i + 2 of blue, green and red: their luma is 3i + 1.185.
      EXPECT_EQ((*frame)->image.pixels[static_cast<size_t>(i)], number == 0 ? i : 3 * i + 1);
    }
  }
  const auto end = (*source)->read();
  ASSERT_TRUE(end.ok());
  EXPECT_FALSE(*end);
}

// 10 bits per pixel become 8, in order; what is not read is told, and does not stop the others.
TEST_F(MadeBags, Aedat4FramesOf16Bits) {
  if (!make("aedat4-lz4-1", "aedat4")) GTEST_SKIP() << kMissing;
  auto source = open_frames(path("aedat4-lz4-1"));
  ASSERT_TRUE(source.ok()) << source.error().message;
  std::vector<GreyFrame> frames;
  for (;;) {
    auto frame = (*source)->read();
    ASSERT_TRUE(frame.ok()) << frame.error().message;
    if (!*frame) break;
    frames.push_back(**std::move(frame));
  }
  ASSERT_EQ(frames.size(), 6u);
  for (size_t i = 0; i < 48; ++i) {
    EXPECT_EQ(frames[2].image.pixels[i], i * 1023 / 47 / 4);
    // Of blue, green and red from 12i on, by fours: the colours are 3i, 3i + 1 and 3i + 2 in 8 bits.
    EXPECT_EQ(frames[3].image.pixels[i], 3 * i + 1);
    EXPECT_EQ(frames[4].image.pixels[i], i) << "four channels, each sample a quarter";
    EXPECT_EQ(frames[5].image.pixels[i], i * 1365 / 256) << "as 16 bits, once a sample had so many";
  }
  EXPECT_EQ(frames[2].t, kUnixTime + 3000);
  EXPECT_EQ((*source)->passed_over().count, 2u);
  EXPECT_THAT((*source)->passed_over().first->what, HasSubstr("8SC1"));

  ReadOptions strict;
  strict.strict = true;
  source = open_frames(path("aedat4-lz4-1"), strict);
  ASSERT_TRUE(source.ok() && (*source)->read().ok() && (*source)->read().ok());
  const auto refused = (*source)->read();
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("8SC1"));
}

TEST_F(MadeBags, Aedat4Triggers) {
  if (!make("aedat4-lz4-1", "aedat4")) GTEST_SKIP() << kMissing;
  EXPECT_EQ(triggers("aedat4-lz4-1"),
            (std::vector<Trigger>{
                {kUnixTime, 0, 1}, {kUnixTime + 1, 0, 0}, {kUnixTime + 3, 1, 1}, {kUnixTime + 4, 1, 0}}));
}

}  // namespace
}  // namespace scarf
