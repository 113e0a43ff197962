// External triggers of the Prophesee formats.
#include <gmock/gmock.h>

#include <bit>

#include "io_test_helpers.h"
#include "scarf/frames.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Triggers {
  std::vector<Trigger> list;
  std::string error;
};

Triggers triggers_of(const Bytes& bytes, const ReadOptions& options = {}, size_t batch = 100) {
  const TemporaryFile file(bytes);
  auto source = open_triggers(file.path(), options);
  if (!source) return {{}, source.error().message};
  Triggers triggers;
  std::vector<Trigger> buffer(batch);
  for (;;) {
    const auto count = (*source)->read(buffer);
    if (!count) triggers.error = count.error().message;
    if (!count || *count == 0) return triggers;
    triggers.list.insert(triggers.list.end(), buffer.begin(),
                         buffer.begin() + static_cast<ptrdiff_t>(*count));
  }
}

TEST(Triggers, OfEvt2) {
  // ts 0b000011, input 0b10001, value 1; then in an IMU block; then value 0.
  const Bytes bytes = evt2_file({0xA0000001u, 0x80000001u, 0b1010'000011'000000000'10001'0000000'1u,
                                 0x10000000u, 0xD0000000u, 0xA0000001u, 0x80000009u, 0, 0, 0, 0xA0000000u});
  for (const size_t batch : {size_t{1}, size_t{100}}) {
    EXPECT_THAT(triggers_of(bytes, {}, batch).list, ElementsAre(Trigger{67, 17, 1}, Trigger{64, 0, 0}));
  }
}

TEST(Triggers, OfEvt21InBothByteOrders) {
  const std::vector<uint64_t> words = {0x8ull << 60 | 2ull << 32,
                                       0b1010'000011'000000000'10001'0000000'1ull << 32, 0xAull << 60};
  Bytes little = bytes_of("% evt 2.1\n% endianness little\n% end\n");
  Bytes legacy = bytes_of("% evt 2.1\n% endianness legacy\n% end\n");
  for (const uint64_t word : words) {
    append_little_endian(little, word);
    append_little_endian(legacy, std::rotl(word, 32));
  }
  EXPECT_THAT(triggers_of(little).list, ElementsAre(Trigger{131, 17, 1}, Trigger{128, 0, 0}));
  EXPECT_EQ(triggers_of(legacy).list, triggers_of(little).list);
}

TEST(Triggers, OfEvt3) {
  EXPECT_THAT(triggers_of(evt3_file({0xA001, 0x8001, 0x6002, 0xA601, 0x2001, 0x6003, 0xA600})).list,
              ElementsAre(Trigger{4098, 6, 1}, Trigger{4099, 6, 0}));
}

TEST(Triggers, OfEvt4) {
  // The mask of a vector looks like a trigger.
  EXPECT_THAT(triggers_of(with_words<uint32_t>("% evt 4.0\n% end\n",
                                               {0x90000001u, 0xE0000001u, 0xD0000000u, 0x90000001u,
                                                0b1001'000011'000000000'10001'1111111'1u}))
                  .list,
              ElementsAre(Trigger{67, 17, 1}));
}

TEST(Triggers, OfDat) {
  EXPECT_THAT(
      triggers_of(with_words<uint32_t>("% Version 2\n\x0E\x08", {0xFFFFFFFFu, 0x1101u, 3, 0x0200u})).list,
      ElementsAre(Trigger{0xFFFFFFFFll, 17, 1}, Trigger{(int64_t{1} << 32) + 3, 2, 0}));
  EXPECT_THAT(triggers_of(with_words<uint32_t>("% Version 2\n\x0C\x08", {1, 1})).error,
              HasSubstr("no triggers"));
}

TEST(Triggers, RefuseWhatTheyHaveNoUseFor) {
  EXPECT_THAT(
      triggers_of(evt2_file({0x80000001u}), {.sensor = std::nullopt, .time_shift = TimeShift::first_event})
          .error,
      HasSubstr("--time-shift"));
  EXPECT_THAT(triggers_of(bytes_of("0.1 1 1 1\n")).error, HasSubstr("no triggers"));
}

}  // namespace
}  // namespace scarf
