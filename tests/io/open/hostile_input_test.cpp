// Any bytes at all, in pieces of any size: never a crash, and the same events however they are read.
#include <filesystem>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

// Small files with words of every kind, and text.
std::vector<Bytes> seeds() {
  std::mt19937 random(5);
  Bytes evt3 = bytes_of("% evt 3.0\n% geometry 1500x1200\n% end\n");
  Bytes evt2 = bytes_of("% evt 2.0\n% geometry 1500x1200\n% end\n");
  constexpr uint32_t kEvt2Types[] = {0, 1, 8, 0, 1, 0, 1, 0xA, 0xE, 0xF, 1, 0xD, 5, 0, 1, 8};
  for (int i = 0; i < 120; ++i) {
    const uint32_t word = i == 0 ? 0x8001 : static_cast<uint32_t>(random()) & 0xFFFF;
    for (int b = 0; b < 2; ++b) evt3.push_back(static_cast<uint8_t>(word >> (8 * b)));
    const uint32_t type = i == 0 ? 8 : kEvt2Types[random() % 16];
    const uint32_t word2 = (static_cast<uint32_t>(random()) & 0x0FFFFFFF) | type << 28;
    for (int b = 0; b < 4; ++b) evt2.push_back(static_cast<uint8_t>(word2 >> (8 * b)));
  }
  // The other word formats, likewise; EVT2.1 in both byte orders.
  Bytes evt4 = bytes_of("% evt 4.0\n% geometry 1500x1200\n% end\n");
  Bytes little = bytes_of("% format EVT21;endianness=little;width=1500;height=1200\n% end\n");
  Bytes legacy = bytes_of("% format EVT21;endianness=legacy;width=1500;height=1200\n% end\n");
  Bytes dat = bytes_of("% Version 2\n% Width 9000\n% Height 9000\n% end\n\x0C\x08");
  constexpr uint32_t kEvt4Types[] = {0xA, 0xB, 0xC, 0xD, 0xA, 0xB, 0xE, 0x6, 0x7, 0x9, 0xF, 0x2, 0xD};
  for (int i = 0; i < 60; ++i) {
    const auto payload = static_cast<uint32_t>(random()) & 0x0FFFFFFF;
    append_little_endian(evt4, payload | (i == 0 ? 0xE : kEvt4Types[random() % 13]) << 28);
    const uint32_t upper = payload | (i == 0 ? 8 : kEvt2Types[random() % 16]) << 28;
    const auto lower = static_cast<uint32_t>(random() & random() & random());
    append_little_endian(little, uint64_t{upper} << 32 | lower);
    append_little_endian(legacy, uint64_t{lower} << 32 | upper);
    append_little_endian(dat, static_cast<uint32_t>(random()));
    append_little_endian(dat, static_cast<uint32_t>(random()) & 0x1FFFFFFF);
  }
  dat.resize(dat.size() - 1);
  return {
      evt2,
      evt3,
      evt4,
      little,
      legacy,
      dat,
      bytes_of(
          "# c\n240 180\n0.1 1 2 1\n\n0.05 3 4 0\r\nx\n0.2,999,1,true\n1e-3 99999 1 1\n-1.5 2 3 -1\n0.3 1")};
}

// Formats that cannot hold all that seeds() have: times of Event Stream only rise, YARP has no sensor.
std::vector<Bytes> other_seeds() {
  std::mt19937 random(9);
  std::vector<Bytes> files;
  for (const uint8_t type : {uint8_t{1}, uint8_t{2}}) {
    Bytes es = bytes_of("Event Stream");
    es.insert(es.end(), {2, 0, 0, type, 40, 0, 30, 0});
    for (int i = 0; i < 80; ++i) {
      if (random() % 8 == 0) es.push_back(static_cast<uint8_t>(0xFE + random() % 2));
      es.push_back(static_cast<uint8_t>(random() % 0xFC));
      for (const uint32_t extent : {44u, 33u})
        append_little_endian(es, static_cast<uint16_t>(random() % extent));
    }
    files.push_back(es);
  }
  const std::string dictionary =
      "{'descr': [('x', '<i2'), ('', 'V1'), ('y', '>u2'), ('p', '|i1'), ('t', '<i4')], 'fortran_order': "
      "False, "
      "'shape': (60,)}";
  Bytes structured =
      bytes_of(std::string("\x93NUMPY\1\0", 8) + static_cast<char>(dictionary.size()) + '\0' + dictionary);
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 5; ++k) structured.push_back(static_cast<uint8_t>(random()));
    structured.push_back(static_cast<uint8_t>(random() % 4 - 1));
    append_little_endian(structured, static_cast<uint32_t>(random()));
  }
  files.push_back(structured);
  Bytes log = bytes_of(
      "1 0.5 AE (25 8193 1073741800 12290 7 4097)\n2 0.6 IMUS (1 2)\n3 0.7 AE (1 67108864 2 5)\nx\n4 0.8 AE "
      "(");
  files.push_back(log);
  files.push_back(
      bytes_of("1 0.5 AE 3 \"abc\\0def\\0\\n\\\"x\\0\\\\ x\\0\"\n2 0.6 0.7 AE 1 \"\"\n3 0.7 AE 9 "
               "\"abcde\"\n4 0.8 AE 2 \"ab"));
  Bytes aedat2 = bytes_of("#!AER-DAT2.0\r\n# AEChip: DAVIS240C\r\n");
  Bytes aedat3 = bytes_of("#!AER-DAT3.1\r\n#Source 1: DVS128\r\n#!END-HEADER\r\n");
  for (int i = 0; i < 60; ++i) {
    // Big-endian: the bytes of rows and columns up to 255 first, and now and then any bits.
    append_little_endian(aedat2, static_cast<uint32_t>(random()) & (i % 8 == 0 ? ~0U : 0x00F80F3FU));
    append_little_endian(aedat2, static_cast<uint32_t>(random()));
    if (i % 12 == 0) {
      const auto type = static_cast<int16_t>(i == 24 ? 0 : 1);
      for (const int16_t half : {type, int16_t{1}}) append_little_endian(aedat3, half);
      for (const int32_t word : {8, 4, i / 30, 12, 12, 12}) append_little_endian(aedat3, word);
    }
    append_little_endian(aedat3, static_cast<uint32_t>(random()) & (i % 8 == 0 ? ~0U : 0x01FE01FFU));
    append_little_endian(aedat3, static_cast<int32_t>(random() >> (i % 9 == 0 ? 0 : 12)));
  }
  aedat2.pop_back();
  files.push_back(aedat2);
  files.push_back(aedat3);
  files.push_back(
      bytes_of("%geometry:40,30\n1,2,1,100\n3,4,0,90\n50,4,0,95\n-1,4,1,7\n1,2,x,8\n1,2,1,9000000000\n1,2"));
  return files;
}

std::vector<Bytes> small_files() {
  std::vector<Bytes> files = seeds();
  for (Bytes& file : other_seeds()) files.push_back(std::move(file));
  return files;
}

void expect_same_however_read(const Bytes& bytes) {
  const auto whole = read_all(bytes, {}, 100'000);
  for (const size_t batch : {1, 2, 11, 13}) {
    const auto r = read_all(bytes, {}, batch);
    EXPECT_EQ(r.events, whole.events);
    EXPECT_EQ(r.report, whole.report);
  }
  for (const size_t step : {1, 3, 7}) {
    const auto r = read_all(dripping(bytes, step), {}, 5);
    EXPECT_EQ(r.events, whole.events);
    EXPECT_EQ(r.report, whole.report);
    EXPECT_EQ(r.error, whole.error);
  }
}

TEST(HostileInput, TheSeedsHoldEvents) {
  for (const Bytes& bytes : seeds()) {
    const auto r = read_all(bytes);
    EXPECT_EQ(r.error, "");
    EXPECT_GT(r.events.size(), 2u);
    EXPECT_GT(r.report.outside, 0u);
    EXPECT_GT(r.report.unknown_words + r.report.truncated_bytes, 0u) << r.format;
    EXPECT_GT(r.report.back_steps, 0u);
  }
}

TEST(HostileInput, TheOtherSeedsHoldEvents) {
  for (const Bytes& bytes : other_seeds()) {
    const auto r = read_all(bytes);
    EXPECT_EQ(r.error, "");
    EXPECT_GT(r.events.size(), 1u) << r.format;
    EXPECT_GT(r.report.outside + r.report.unknown_words + r.report.damages, 0u) << r.format;
  }
}

TEST(HostileInput, SmallFilesCutAtEveryLength) {
  for (const Bytes& bytes : small_files()) {
    for (size_t length = 0; length <= bytes.size(); ++length) {
      expect_same_however_read(Bytes(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(length)));
    }
  }
}

TEST(HostileInput, DamagedFiles) {
  std::mt19937 random(6);
  for (const Bytes& original : small_files()) {
    for (int i = 0; i < 300; ++i) {
      Bytes bytes = original;
      for (int k = 0; k < 5; ++k) bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
      expect_same_however_read(bytes);
    }
  }
}

// A second signature farther on, where HDF5 may have its own: what a recording is must not depend on how it
// comes.
TEST(HostileInput, TwoSignatures) {
  using namespace std::string_view_literals;
  for (const std::string_view first : {"#ROSBAG V2.0\n"sv, "\x89MCAP0\r\n"sv, "#!AER-DAT4.0\r\n"sv}) {
    Bytes bytes = bytes_of(first);
    bytes.resize(512);
    for (const char c : "\x89HDF\r\n\x1A\n"sv) bytes.push_back(static_cast<uint8_t>(c));
    bytes.resize(1000);
    expect_same_however_read(bytes);
    EXPECT_EQ(read_all(bytes).error.find("HDF5"), std::string::npos);
  }
}

TEST(HostileInput, RandomBytes) {
  std::mt19937 random(7);
  for (const char* header :
       {"", "% evt 2.0\n% end\n", "% evt 3.0\n% end\n", "% evt 3.0\n% geometry 640x480\n", "% system_ID 21\n",
        "% evt 2.1\n% end\n", "% evt 2.1\n% endianness legacy\n", "% evt 4.0\n% end\n",
        "% Version 1\n\x0C\x08", "240 180\n0.1 1 1 1\n"}) {
    for (int i = 0; i < 20; ++i) {
      Bytes bytes = bytes_of(header);
      const size_t length = random() % 3000;
      for (size_t k = 0; k < length; ++k) bytes.push_back(static_cast<uint8_t>(random()));
      expect_same_however_read(bytes);
    }
  }
}

TEST(HostileInput, RandomBytesWithoutAHeaderAreNotRecognised) {
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    Bytes bytes;
    for (int k = 0; k < 2000; ++k) bytes.push_back(static_cast<uint8_t>(random()));
    EXPECT_NE(read_all(bytes).error, "") << i;
  }
}

}  // namespace
}  // namespace scarf
