// External triggers of the Prophesee formats.
#include <gmock/gmock.h>

#include <bit>

#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"

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

// Events and triggers with gaps, wraps of the clocks and equal times, in the order in which they are written.
struct Mixed {
  std::vector<Event> events;
  std::vector<Trigger> triggers;
  std::vector<bool> is_event;
};

Mixed mixed_stream(uint32_t seed, uint16_t inputs, int64_t largest_gap) {
  std::mt19937_64 random(seed);
  Mixed mixed;
  int64_t t = static_cast<int64_t>(random() % 100);
  for (int i = 0; i < 3000; ++i) {
    if (random() % 3 == 0) t += static_cast<int64_t>(random() % 100);
    if (random() % 100 == 0) t += static_cast<int64_t>(random() % static_cast<uint64_t>(largest_gap));
    mixed.is_event.push_back(random() % 4 != 0);
    if (!mixed.is_event.back()) {
      mixed.triggers.push_back(
          {t, static_cast<uint16_t>(random() % inputs), static_cast<uint8_t>(random() % 2)});
      continue;
    }
    // Runs of neighbours, for vectors that triggers cut.
    const auto x = static_cast<uint16_t>(mixed.events.size() % 600);
    mixed.events.push_back({t, x, static_cast<uint16_t>(i / 64 % 480), static_cast<uint8_t>(i / 128 % 2)});
  }
  return mixed;
}

TEST(Triggers, AreWrittenAmongTheEventsAndComeBack) {
  for (const auto& [format, inputs] :
       {std::pair<std::string, uint16_t>{"evt2", 32}, {"evt21", 32}, {"evt3", 16}, {"evt4", 32}}) {
    for (uint32_t seed = 0; seed < 6; ++seed) {
      const Mixed mixed = mixed_stream(seed, inputs, seed % 2 == 0 ? 5'000 : 40'000'000);
      const TemporaryFile file;
      auto sink = *create_events(file.path(), format, {640, 480}, {.overwrite = true});
      size_t event = 0;
      size_t trigger = 0;
      for (const bool is_event : mixed.is_event) {
        const auto written = is_event ? sink->write({&mixed.events[event++], 1})
                                      : sink->write_triggers({&mixed.triggers[trigger++], 1});
        ASSERT_TRUE(written.ok()) << written.error().message;
      }
      ASSERT_TRUE(sink->finish().ok());
      const Bytes content = file.content();
      const Recording recording = read_all(content);
      EXPECT_TRUE(recording.events == mixed.events) << format << " " << seed;
      EXPECT_EQ(recording.report.unknown_words, 0u) << format;
      const Triggers read = triggers_of(content);
      EXPECT_EQ(read.error, "");
      EXPECT_TRUE(read.list == mixed.triggers) << format << " " << seed;
    }
  }
}

TEST(Triggers, AreWordsOfTheFormat) {
  const std::vector<Trigger> triggers = {{67, 17 % 16, 1}};
  const auto words_of = [&](const std::string& format) {
    const TemporaryFile file;
    auto sink = *create_events(file.path(), format, {640, 480}, {.overwrite = true});
    EXPECT_TRUE(sink->write_triggers(triggers).ok());
    EXPECT_TRUE(sink->finish().ok());
    const Bytes content = file.content();
    const std::string_view all(reinterpret_cast<const char*>(content.data()), content.size());
    return Bytes(content.begin() + static_cast<ptrdiff_t>(all.find("% end\n") + 6), content.end());
  };
  EXPECT_EQ(words_of("evt2"),
            with_words<uint32_t>("", {0x80000001u, 0b1010'000011'000000000'00001'0000000'1u}));
  EXPECT_EQ(words_of("evt21"), with_words<uint64_t>("", {0x80000001ull << 32,
                                                         0b1010'000011'000000000'00001'0000000'1ull << 32}));
  EXPECT_EQ(words_of("evt3"), with_words<uint16_t>("", {0x8000, 0x6043, 0xA101}));
  EXPECT_EQ(words_of("evt4"),
            with_words<uint32_t>("", {0xE0000001u, 0b1001'000011'000000000'00001'0000000'1u}));
}

TEST(Triggers, AreRefusedWhereTheyCannotBeHeld) {
  const auto refusal = [](const std::string& format, const Trigger& trigger) {
    const TemporaryFile file;
    auto sink = *create_events(file.path(), format, {640, 480}, {.overwrite = true});
    const Event event = {100, 1, 2, 1};
    EXPECT_TRUE(sink->write({&event, 1}).ok());
    const auto written = sink->write_triggers({&trigger, 1});
    if (written) return std::string();
    EXPECT_EQ(written.error().code, ErrorCode::bad_input);
    return written.error().message;
  };
  for (const FormatInfo& format : formats()) {
    if (!format.written) continue;
    EXPECT_EQ(refusal(format.name, {100, 3, 1}) == "", format.writes_triggers) << format.name;
    if (!format.writes_triggers) continue;
    EXPECT_THAT(refusal(format.name, {99, 3, 1}), HasSubstr("before that of the event"));
    EXPECT_THAT(refusal(format.name, {100, 32, 1}), HasSubstr("inputs"));
    EXPECT_EQ(refusal(format.name, {100, 16, 1}) == "", format.name != "evt3");
    EXPECT_THAT(refusal(format.name, {100, 3, 2}), HasSubstr("0 or 1"));
    EXPECT_THAT(refusal(format.name, {int64_t{1} << 46, 3, 1}), HasSubstr("so late"));
  }
}

TEST(Triggers, RefuseWhatTheyHaveNoUseFor) {
  EXPECT_THAT(
      triggers_of(evt2_file({0x80000001u}), {.sensor = std::nullopt, .time_shift = TimeShift::first_event})
          .error,
      HasSubstr("ReadOptions::time_shift"));
  EXPECT_THAT(triggers_of(bytes_of("0.1 1 1 1\n")).error, HasSubstr("no triggers"));
}

}  // namespace
}  // namespace scarf
