// ECF by bit, against an encoder in Python, and on hostile bytes.
#include "io/hdf5/ecf_codec.h"

#include "tests/io/hdf5/hdf5_test_helpers.h"

namespace scarf::hdf5 {
namespace {

// A chunk with its header and first time.
Bytes chunk(uint32_t count, uint32_t mode, std::initializer_list<uint8_t> more) {
  Bytes bytes;
  append_little_endian(bytes, count << 2 | mode);
  append_little_endian(bytes, int64_t{1000});
  bytes.insert(bytes.end(), more);
  return bytes;
}

std::vector<Event> decoded(const Bytes& bytes) {
  std::vector<Event> events;
  const auto r = decode_ecf(bytes, events);
  EXPECT_TRUE(r.ok()) << r.error().message;
  return events;
}

TEST(EcfCodec, RunsOfTimesRowsMasksAndPolarities) {
  // Times: 2 at +3; a long step of 0x12 (nibbles 2, 1), then 1 more at +1. Rows: 3 at y 5. Columns: 100 and
  // the mask 01001: 102 and 105. Polarities: 2 ON, 1 OFF.
  const auto events = decoded(chunk(3, 0, {0x32, 0xF2, 0xF1, 0x11, 0xA3, 0x00, 0x89, 0x0C, 0x82, 0x01}));
  EXPECT_EQ(events, (std::vector<Event>{{1003, 100, 5, 1}, {1003, 102, 5, 1}, {1022, 105, 5, 0}}));
}

TEST(EcfCodec, PackedYxp) {
  // a0: y 1, x 2, p 1 = 0x001005; a1: y 0x7FF, x 0x7FF, p 0 = 0x7FFFFE; the last two are padding.
  const auto events =
      decoded(chunk(2, 2, {0x02, 0xFE, 0x05, 0x10, 0x00, 0x00, 0x00, 0xFF, 0x7F, 0x00, 0x00, 0x00, 0x00}));
  EXPECT_EQ(events, (std::vector<Event>{{1000, 2, 1, 1}, {1000, 0x7FF, 0x7FF, 0}}));
}

TEST(EcfCodec, RefusesRunsBeyondTheEndAndMissingBytes) {
  std::vector<Event> events(3);
  for (const Bytes& bytes :
       {Bytes{}, Bytes{4, 0, 0}, chunk(1, 2, {}), chunk(1, 2, {0x02}), chunk(1, 0, {0x01, 0x22, 0x00}),
        chunk(70'000, 2, {0x01}), chunk(1, 0, {0x01, 0x01, 0x00, 0x10, 0x00, 0x01}),
        chunk(1, 0,
              {0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0,
               0xF0, 0xF0})}) {
    EXPECT_FALSE(decode_ecf(bytes, events).ok());
    EXPECT_TRUE(events.empty());
  }
}

TEST(EcfCodec, AnyBytesGiveEventsOrAnError) {
  std::mt19937 engine(3);
  const auto random = [&engine] { return static_cast<uint32_t>(engine()); };
  std::vector<Event> events;
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes = chunk(random() % 40, random() % 4, {});
    for (uint32_t n = random() % 100; n > 0; --n)
      bytes.push_back(static_cast<uint8_t>(random() % 3 == 0 ? random() : random() % 8));
    if (!decode_ecf(bytes, events)) {
      EXPECT_TRUE(events.empty());
    }
    for (const Event& e : events) EXPECT_LE(e.p, 1);
  }
}

class EcfChunks : public Hdf5Test {};

TEST_F(EcfChunks, OfAnotherEncoderInAllModesAndSizes) {
  const int status = python("ecf-chunks", path("chunks"));
  if (status == kModuleMissing) GTEST_SKIP() << kMissing;
  ASSERT_EQ(status, 0);
  std::ifstream file(path("chunks"), std::ios::binary);
  const Bytes bytes(std::istreambuf_iterator<char>(file), {});
  size_t chunks = 0;
  for (size_t at = 0; at < bytes.size(); ++chunks) {
    const auto count = load_little_endian<uint32_t>(&bytes[at]);
    const auto length = load_little_endian<uint32_t>(&bytes[at + 4]);
    at += 8;
    const auto found = decoded(Bytes(&bytes[at], &bytes[at] + length));
    at += length;
    ASSERT_EQ(found.size(), count);
    for (const Event& e : found) {
      ASSERT_EQ(e.t, load_little_endian<int64_t>(&bytes[at])) << count;
      ASSERT_EQ(e.x, load_little_endian<uint16_t>(&bytes[at + 8])) << count;
      ASSERT_EQ(e.y, load_little_endian<uint16_t>(&bytes[at + 10])) << count;
      ASSERT_EQ(e.p, bytes[at + 12]) << count;
      at += 13;
    }
  }
  EXPECT_EQ(chunks, 60u);
}

}  // namespace
}  // namespace scarf::hdf5
