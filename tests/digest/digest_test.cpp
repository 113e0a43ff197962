#include "scarf/digest/digest.h"

#include <gtest/gtest.h>

#include "scarf/reference/reference.h"

namespace scarf {
namespace {

// The expected values come from sha256sum over bytes written by hand.

TEST(Digest, KnownValues) {
  Digest digest;
  EXPECT_EQ(digest.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const std::vector<uint8_t> abc = {'a', 'b', 'c'};
  digest.add(abc);
  EXPECT_EQ(digest.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  for (const uint8_t letter : abc) digest.add(std::span(&letter, 1));
  EXPECT_EQ(digest.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(StateDigest, BytesWorkedOutByHand) {
  // Patch 0 is active on 0..1 with the field 0..2, patch 1 is active on 2..3 with the field 2..3. N = 2.
  const Geometry geometry = {{4, 2, 0, 2, 0, 1}, {1, 1, 0, 1, 0, 0}, 2};
  auto scarf = make_reference_scarf(geometry);
  ASSERT_TRUE(scarf.ok());
  const std::vector<Event> events = {{5, 0, 0, 0}, {(int64_t{1} << 40) + 1, 2, 0, 0}, {-2, 1, 0, 1}};
  ASSERT_TRUE((*scarf)->push(events).ok());
  const auto snapshot = (*scarf)->snapshot().wait();
  ASSERT_TRUE(snapshot.ok());

  EXPECT_EQ(state_bytes(*snapshot, 0),
            (std::vector<uint8_t>{
                3, 0, 0, 0, 0, 0, 0,    0,  // total
                1, 0, 0, 0, 1, 1, 0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                2, 0, 0, 0, 0, 0, 1,    0,    0,    0,    0,    1,    0,    0,  // inactive
            }));
  EXPECT_EQ(state_bytes(*snapshot, 1),
            (std::vector<uint8_t>{
                1, 0, 0, 0, 0, 0, 0, 0,                    // total
                2, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0,  // the empty slot is left out
            }));
  EXPECT_EQ(state_digest(*snapshot), "28b560e8ade95dea23535bca04808d9c0be4da4185e615c3adbb398b234aeb1c");
}

TEST(EventDigest, BytesWorkedOutByHand) {
  // 08 07 06 05 04 03 02 01  02 01  04 03  01, then ff * 8  00 00  ff 3f  00.
  EventDigest digest;
  digest.add({0x0102030405060708, 0x0102, 0x0304, 1});
  digest.add({-1, 0, 0x3fff, 0});
  EXPECT_EQ(digest.hex(), "4f27d89791a7e4fba9d202d8573bc6eff48322b0149a1202c22dd23c806e645a");
  EXPECT_EQ(digest.hex(), Digest().hex());  // anew
}

TEST(EventDigest, LongStreamsAreHashedWhole) {
  EventDigest by_event;
  Digest by_byte;
  for (int i = 0; i < 20'000; ++i) {
    const auto x = static_cast<uint8_t>(i % 251);
    by_event.add({0, x, 0, 1});
    by_byte.add(std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, x, 0, 0, 0, 1});
  }
  EXPECT_EQ(by_event.hex(), by_byte.hex());
}

TEST(ImageDigest, HashesThePixelsOnly) {
  Image<uint8_t> image(3, 2);
  image.pixels = {0, 76, 153, 230, 255, 1};
  EXPECT_EQ(image_digest(image), "8d29185998851d78b6a3166e53e9ccf7b6352635896d857ef98b5997659b3bee");
}

}  // namespace
}  // namespace scarf
