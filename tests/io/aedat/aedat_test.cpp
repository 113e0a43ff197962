// AEDAT 1 to 3.1 out of files that a Python script writes from the formats' descriptions: real events,
// re-encoded, or made-up ones without recordings. And what is odd, by the byte.
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>

#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"
#include "tests/io/python_recordings.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr SensorSize kDavis240{240, 180};
constexpr SensorSize kDavis346{346, 260};
constexpr SensorSize kDvs128{128, 128};
constexpr SensorSize kDvs640{640, 480};

// Events within a sensor: those of a recording if there are some, else made up. The clock of 32 bits has its
// first wrap among them.
std::vector<Event> events_within(SensorSize sensor) {
  constexpr size_t kEvents = 20'000;
  std::vector<Event> events;
  if (const char* const folder = std::getenv("SCARF_DATA_DIR")) {
    auto source = open_events(std::string(folder) + "/raw/vga_evt2_sparks.raw");
    if (source) events = read_all(*std::move(source), 4096).events;
    std::erase_if(events, [&](const Event& e) { return e.x >= sensor.width || e.y >= sensor.height; });
  }
  std::mt19937 random(7);
  const int64_t start = events.empty() ? 0 : events.back().t;
  for (int64_t t = start; events.size() < kEvents; t += static_cast<int64_t>(random() % 30)) {
    const auto width = static_cast<unsigned>(sensor.width);
    const auto height = static_cast<unsigned>(sensor.height);
    events.push_back({t, static_cast<uint16_t>(random() % width), static_cast<uint16_t>(random() % height),
                      static_cast<uint8_t>(random() % 2)});
  }
  events.resize(kEvents);
  const int64_t first = (int64_t{1} << 31) - (events[kEvents / 2].t - events[0].t);
  const int64_t shift = first - events[0].t;
  for (Event& e : events) e.t += shift;
  return events;
}

class Aedat : public PythonRecordings {
 protected:
  /// Writes events within a sensor as a file of this kind.
  void make(const std::string& kind, SensorSize sensor) {
    events = events_within(sensor);
    write_events(events);
    ASSERT_EQ(python(SCARF_MAKE_AEDAT, kind, path(kind)), 0);
  }

  Recording read(const std::string& kind, const ReadOptions& options = {}) const {
    return read_path(path(kind), options, 77);
  }

  void expect_written(const Recording& r, const std::string& format, SensorSize sensor,
                      uint64_t skipped) const {
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.format, format);
    EXPECT_EQ(r.sensor, sensor);
    EXPECT_TRUE(r.events == events);
    EXPECT_EQ(r.report.skipped, skipped);
    EXPECT_EQ(r.report.outside + r.report.back_steps + r.report.unknown_words + r.report.truncated_bytes +
                  r.report.damages,
              0u);
  }

  std::vector<Event> events;
};

std::vector<Trigger> triggers_of(const std::string& path, const ReadOptions& options = {}) {
  const auto source = open_triggers(path, options);
  EXPECT_TRUE(source.ok()) << source.error().message;
  std::vector<Trigger> all;
  std::array<Trigger, 2> some;
  for (;;) {
    const auto count = source ? (*source)->read(some) : Result<size_t>(size_t{0});
    EXPECT_TRUE(count.ok());
    if (!count || *count == 0) return all;
    all.insert(all.end(), some.begin(), some.begin() + static_cast<ptrdiff_t>(*count));
  }
}

TEST_F(Aedat, Version2OfJaerWithPreferencesSamplesAndTriggers) {
  make("davis240", kDavis240);
  expect_written(read("davis240"), "aedat2", kDavis240, 3 * events.size() / 50);
  const auto triggers = triggers_of(path("davis240"));
  ASSERT_EQ(triggers.size(), events.size() / 50);
  for (size_t i = 0; i < triggers.size(); ++i) {
    EXPECT_EQ(triggers[i], (Trigger{events[50 * i + 7].t, 0, static_cast<uint8_t>(i % 2)}));
  }
  EXPECT_THAT(read("davis240", {kDavis346}).error, AllOf(HasSubstr("240x180"), HasSubstr("346x260")));
}

TEST_F(Aedat, Version2OfADavis346) {
  make("davis346", kDavis346);
  expect_written(read("davis346"), "aedat2", kDavis346, 0);
}

TEST_F(Aedat, Version2OfV2eHasNoChip) {
  make("v2e346", kDavis346);
  expect_written(read("v2e346", {kDavis346}), "aedat2", kDavis346, 0);
  EXPECT_THAT(read("v2e346").error,
              AllOf(HasSubstr("AEChip"), HasSubstr("ReadOptions::sensor"), HasSubstr("346x260")));
  EXPECT_THAT(read("v2e346", {SensorSize{100, 100}}).error, HasSubstr("128x128"));
}

TEST_F(Aedat, NoiseThatV2eLabelsIsEvents) {
  make("v2e346-noise", kDavis346);
  expect_written(read("v2e346-noise", {kDavis346}), "aedat2", kDavis346, 0);
}

TEST_F(Aedat, Version2OfV2eIn640x480) {
  make("v2e640", kDvs640);
  expect_written(read("v2e640", {kDvs640}), "aedat2", kDvs640, 0);
}

TEST_F(Aedat, Version2OfADvs128) {
  make("dvs128", kDvs128);
  expect_written(read("dvs128"), "aedat2", kDvs128, events.size() / 100);
  const auto triggers = triggers_of(path("dvs128"));
  ASSERT_EQ(triggers.size(), events.size() / 100);
  EXPECT_EQ(triggers[0], (Trigger{events[3].t, 0, 1}));
}

TEST_F(Aedat, TheSensorChoosesWhatAddressesMeanWhereNoChipIsNamed) {
  make("dvs128-no-chip", kDvs128);
  expect_written(read("dvs128-no-chip", {kDvs128}), "aedat2", kDvs128, 0);
}

TEST_F(Aedat, Version1IsReadByName) {
  make("aedat1", kDvs128);
  expect_written(read("aedat1", read_options("", "", "", "aedat1")), "aedat1", kDvs128, 0);
}

TEST_F(Aedat, Version3) {
  make("aedat3", kDavis240);
  expect_written(read("aedat3"), "aedat3", kDavis240, 0);
  make("aedat3-dvs128", kDvs128);
  expect_written(read("aedat3-dvs128"), "aedat3", kDvs128, 0);
}

TEST_F(Aedat, Version3WithTwoCamerasFramesTriggersAndInvalidEvents) {
  make("aedat3-mixed", kDavis240);
  EXPECT_THAT(read("aedat3-mixed").error, AllOf(HasSubstr("ReadOptions::stream"), HasSubstr("0 (DAVIS240C)"),
                                                HasSubstr("1 (DAVIS346B)")));
  const auto r = read("aedat3-mixed", read_options("0"));
  // In each packet's company: 6 special records, a frame, the IMU, and an event that is not valid.
  EXPECT_EQ(r.report.skipped % 9, 0u);
  EXPECT_GT(r.report.skipped, 9 * events.size() / 700 - 1);
  expect_written(r, "aedat3", kDavis240, r.report.skipped);
  auto other = read("aedat3-mixed", read_options("1"));
  for (Event& e : other.events) e.p = 1 - e.p;
  expect_written(other, "aedat3", kDavis346, 0);

  const int64_t t = events[0].t;
  const auto triggers = triggers_of(path("aedat3-mixed"), read_options("0"));
  ASSERT_GE(triggers.size(), 4u);
  EXPECT_THAT(
      std::vector<Trigger>(triggers.begin(), triggers.begin() + 4),
      ElementsAre(Trigger{t, 0, 1}, Trigger{t + 1, 0, 0}, Trigger{t + 3, 1, 1}, Trigger{t + 5, 3, 0}));

  auto frames = open_frames(path("aedat3-mixed"), read_options("0"));
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  const auto grey = (*frames)->read();
  ASSERT_TRUE(grey.ok() && *grey);
  EXPECT_EQ((*grey)->t, t + 20);
  EXPECT_EQ((*grey)->exposure_begin, t + 10);
  EXPECT_EQ((*grey)->exposure_end, t + 30);
  ASSERT_EQ((*grey)->image.width, 4);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ((*grey)->image.pixels[i], 300 * i / 256);
  const auto coloured = (*frames)->read();
  ASSERT_TRUE(coloured.ok() && *coloured);
  // Red 234, green 117, blue 58: 145.3.
  EXPECT_EQ((*coloured)->image.pixels[3], 145);
  EXPECT_EQ((*frames)->passed_over().count, 0u);
  const auto behind = (*frames)->read();
  ASSERT_TRUE(behind.ok() && *behind) << "behind a broken one";
  EXPECT_EQ((*frames)->passed_over().count, 1u);
}

// --- Odd files, by the byte ---
void put_big(Bytes& bytes, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(word >> shift));
}

Bytes aedat2_file(std::initializer_list<std::pair<uint32_t, int64_t>> records, std::string_view header) {
  Bytes bytes = bytes_of(header);
  for (const auto& [address, t] : records) {
    put_big(bytes, address);
    put_big(bytes, static_cast<uint32_t>(t));
  }
  return bytes;
}

constexpr std::string_view kDvsHeader = "#!AER-DAT2.0\r\n# AEChip: x.y.DVS128\r\n";

std::vector<int64_t> times_of(const Recording& r) {
  std::vector<int64_t> times;
  for (const Event& e : r.events) times.push_back(e.t);
  return times;
}

TEST(Aedat2, PolarityBitOfADvs128IsInvertedAndBothAxesTurnedRound) {
  const auto r = read_all(aedat2_file({{0, 5}, {127 << 8 | 3 << 1 | 1, 6}}, kDvsHeader));
  EXPECT_THAT(r.events, ElementsAre(Event{5, 127, 127, 1}, Event{6, 124, 0, 0}));
}

TEST(Aedat2, TimesWrapAndStepBack) {
  constexpr int64_t kTurn = int64_t{1} << 32;
  constexpr int64_t kHalf = int64_t{1} << 31;
  const auto r = read_all(aedat2_file({{0, kHalf - 1},
                                       {0, -kHalf},      // a wrap
                                       {0, kHalf - 2},   // back across it
                                       {0, -kHalf + 5},  // and again
                                       {0, 100},
                                       {0, 40},                        // a back-step
                                       {0, 40 - (int64_t{1} << 30)}},  // the largest back-step
                                      kDvsHeader));
  EXPECT_EQ(r.error, "");
  EXPECT_THAT(times_of(r), ElementsAre(kHalf - 1, kHalf, kHalf - 2, kHalf + 5, kTurn + 100, kTurn + 40,
                                       kTurn + 40 - (int64_t{1} << 30)));
  EXPECT_EQ(r.report.back_steps, 3u);
}

TEST(Aedat2, RecordsThatBeginLikeALineOfTheHeaderAreRecords) {
  // Row 140 of a DAVIS346: the first byte is #. jAER ends its header; v2e does not.
  const uint32_t address = 0x23000000;
  for (const std::string_view end : {"#End Of ASCII Header\r\n", ""}) {
    const std::string header = "#!AER-DAT2.0\r\n# AEChip: Davis346\r\n" + std::string(end);
    const auto r = read_all(aedat2_file({{address, 10}, {address, 0x230A0000}}, header));
    EXPECT_EQ(r.error, "");
    EXPECT_THAT(r.events, ElementsAre(Event{10, 345, 119, 0}, Event{0x230A0000, 345, 119, 0}));
  }
}

TEST(Aedat2, WhatItDoesNotDefineIsCounted) {
  auto bytes = aedat2_file({{1 << 20, 1}, {uint32_t{1} << 31, 2}, {1 << 15, 3}, {0, 4}}, kDvsHeader);
  bytes.push_back(0);
  const auto r = read_all(bytes);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.report.unknown_words, 1u);
  EXPECT_EQ(r.report.skipped, 2u);
  EXPECT_EQ(r.report.truncated_bytes, 1u);
}

TEST(Aedat2, EventsBeyondTheSensorAreOutside) {
  const auto r = read_all(aedat2_file({{400u << 22 | 5 << 12, 1}, {5u << 22 | 1000 << 12, 2}, {5u << 22, 3}},
                                      "#!AER-DAT2.0\n# AEChip: DAVIS240A\n"));
  EXPECT_THAT(r.events, ElementsAre(Event{3, 239, 174, 0}));
  EXPECT_EQ(r.report.outside, 2u);
}

TEST(Aedat2, UnknownChipsAreNamed) {
  const auto error = [](const std::string& chip) {
    return read_all(aedat2_file({{0, 1}}, "#!AER-DAT2.0\r\n# AEChip: a.b." + chip + "\r\n")).error;
  };
  EXPECT_THAT(error("DAS1"), AllOf(HasSubstr("DAS1"), HasSubstr("ReadOptions::sensor")));
  EXPECT_THAT(error("Tmpdiff128StereoPair"), HasSubstr("STEREO"));
  EXPECT_THAT(error("DAVIS999"), AllOf(HasSubstr("DAVIS999"), HasSubstr("ReadOptions::sensor WxH")));
  EXPECT_THAT(read_all(bytes_of("#!AER-DAT2.0\r\n# AEChip: DV")).error, HasSubstr("header"));
}

TEST(Aedat3, DamageIsTold) {
  const std::string header = "#!AER-DAT3.1\r\n#Format: RAW\r\n#Source 2: DVS128\r\n#!END-HEADER\r\n";
  const auto packet = [](int16_t type, int16_t source, int32_t size, int32_t turns, int32_t capacity,
                         int32_t count) {
    Bytes bytes;
    append_little_endian(bytes, type);
    append_little_endian(bytes, source);
    for (const int32_t word : {size, 4, turns, capacity, count, count}) append_little_endian(bytes, word);
    for (int32_t i = 0; i < capacity && i < 2; ++i) {
      append_little_endian(bytes, uint32_t{5 << 17 | 6 << 2 | 3});
      append_little_endian(bytes, 7 - 8 * i);  // the second one has no time
    }
    return bytes;
  };
  const auto read = [&](const std::vector<Bytes>& packets, bool strict = false) {
    Bytes bytes = bytes_of(header);
    for (const Bytes& p : packets) bytes.insert(bytes.end(), p.begin(), p.end());
    ReadOptions options;
    options.strict = strict;
    return read_all(bytes, options);
  };
  const auto fine = read({packet(1, 2, 8, 1, 2, 2)});
  EXPECT_THAT(fine.events, ElementsAre(Event{(int64_t{1} << 31) + 7, 5, 6, 1}));
  EXPECT_EQ(fine.report.unknown_words, 1u);

  const auto other = read({packet(1, 3, 8, 0, 1, 1), packet(1, 2, 8, 0, 1, 1)});
  EXPECT_EQ(other.events.size(), 1u);
  ASSERT_TRUE(other.report.damage.has_value());
  EXPECT_THAT(other.report.damage->what, HasSubstr("camera 3"));
  EXPECT_EQ(other.report.damage->byte, header.size());
  EXPECT_THAT(read({packet(1, 3, 8, 0, 1, 1)}, true).error,
              AllOf(HasSubstr("camera 3"), HasSubstr("ReadOptions::strict")));

  for (const Bytes& hostile : {packet(1, 2, -8, 0, 1, 1), packet(1, 2, 8, 0, 1, 2), packet(1, 2, 8, -1, 1, 1),
                               packet(1, 2, 0x7FFFFFFF, 0, 0x7FFFFFFF, 1), packet(1, 2, 0, 0, 1, 1)}) {
    const auto r = read({packet(1, 2, 8, 0, 1, 1), hostile, packet(1, 2, 8, 0, 1, 1)});
    EXPECT_EQ(r.events.size(), 1u);
    EXPECT_EQ(r.report.damages, 1u);
    EXPECT_GT(r.report.truncated_bytes, 28u);
  }
  const auto short_records = read({packet(1, 2, 4, 0, 2, 2), packet(1, 2, 8, 0, 1, 1)});
  EXPECT_EQ(short_records.report.damages, 2u) << "whose length is wrong, too, here";
}

TEST(Aedat3, HeadersThatDoNotDo) {
  const auto error = [](const std::string& header) { return read_all(bytes_of(header)).error; };
  EXPECT_THAT(error("#!AER-DAT3.1\r\n#Source 0: DVS128\r\n"), HasSubstr("END-HEADER"));
  EXPECT_THAT(error("#!AER-DAT3.1\r\n#Format: RAW\r\n#!END-HEADER\r\n"), HasSubstr("no camera"));
  EXPECT_THAT(error("#!AER-DAT3.1\r\n#Format: Serial-TS\r\n#Source 0: DVS128\r\n#!END-HEADER\r\n"),
              HasSubstr("Serial-TS"));
  EXPECT_THAT(error("#!AER-DAT3.0\r\n"), HasSubstr("another version"));
  const auto unknown = read_all(bytes_of("#!AER-DAT3.1\r\n#Source 0: DYNAPSE\r\n#!END-HEADER\r\n"));
  EXPECT_EQ(unknown.error, "");
  EXPECT_EQ(unknown.sensor, std::nullopt);
}

}  // namespace
}  // namespace scarf
