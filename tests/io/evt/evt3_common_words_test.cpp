// The fast paths of the EVT3 decoder against one that takes a word at a time, on words of all kinds.
#include "io/evt/evt3_common_words.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "io/evt/evt3_decoder.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

struct Decoded {
  std::vector<Event> events;
  uint64_t unknown = 0;
  uint64_t gaps = 0;
};

// docs/FORMATS.md, word by word.
Decoded decode_plainly(const std::vector<uint16_t>& words) {
  Decoded decoded;
  int high = -1;  // before the first TIME_HIGH
  int64_t turns = 0;
  int64_t low = 0;
  uint32_t y = 0, base = 0;
  uint8_t polarity = 0;
  bool brightness = true;
  const auto event = [&](uint32_t x, int p) {
    if (!brightness) return;
    decoded.events.push_back({(turns * 4096 + high) * 4096 + low, static_cast<uint16_t>(x),
                              static_cast<uint16_t>(y), static_cast<uint8_t>(p)});
  };
  const auto vector = [&](uint32_t mask, uint32_t length) {
    for (uint32_t i = 0; i < length; ++i) {
      if ((mask >> i & 1) != 0) event(base + i, polarity);
    }
    base = std::min(base + length, 0xF000u);
  };
  for (const uint16_t word : words) {
    const int payload = word & 0xFFF;
    const int type = word >> 12;
    if (high < 0 && type != 0x8) continue;
    switch (type) {
      case 0x0:
        y = word & 0x7FF;
        brightness = true;
        break;
      case 0x1:
        brightness = false;
        break;
      case 0x2:
        event(word & 0x7FF, payload >> 11);
        break;
      case 0x3:
        base = word & 0x7FF;
        polarity = static_cast<uint8_t>(payload >> 11);
        break;
      case 0x4:
        vector(word, 12);
        break;
      case 0x5:
        vector(word, 8);
        break;
      case 0x6:
        low = payload;
        break;
      case 0x8:
        if (payload == high) break;
        if (high >= 0 && payload != (high + 1) % 4096) ++decoded.gaps;
        if (payload <= high - 2048) ++turns;
        high = payload;
        low = 0;
        break;
      case 0x9:
      case 0xB:
      case 0xC:
        if (word != 0x9999) ++decoded.unknown;
        break;
      default:  // triggers, IMU, others, continuations
        break;
    }
  }
  return decoded;
}

// Pieces of bytes of random lengths, odd ones too, into outputs of random lengths.
Decoded decode_in_pieces(const std::vector<uint16_t>& words, size_t longest, std::mt19937& random) {
  Bytes bytes;
  for (const uint16_t word : words) append_little_endian(bytes, word);
  evt3::EventDecoder decoder;
  Decoded decoded;
  for (size_t at = 0; at < bytes.size();) {
    const size_t piece = std::min(2 + random() % (2 * longest), bytes.size() - at);
    std::vector<Event> out(1 + random() % longest);
    const auto taken = decoder.decode(std::span(bytes).subspan(at, piece), out);
    EXPECT_TRUE(taken.events == out.size() || piece - taken.bytes < 2) << "stopped early";
    decoded.events.insert(decoded.events.end(), out.begin(),
                          out.begin() + static_cast<ptrdiff_t>(taken.events));
    at += taken.bytes;
  }
  // What did not fit the last output.
  for (size_t events = 1; events > 0;) {
    std::vector<Event> out(5);
    events = decoder.decode({}, out).events;
    decoded.events.insert(decoded.events.end(), out.begin(), out.begin() + static_cast<ptrdiff_t>(events));
  }
  decoded.unknown = decoder.unknown_words();
  decoded.gaps = decoder.clock().gaps();
  return decoded;
}

struct Mixture {
  const char* name;
  std::vector<std::vector<uint16_t>> kinds;  // types of words in a row; each payload is random
  uint16_t mask_and = 0xFFF;                 // of payloads: how full vectors are, how often times repeat
};

std::vector<uint16_t> random_words(const Mixture& mixture, size_t count, std::mt19937& random) {
  std::vector<uint16_t> words = {0x8123};
  while (words.size() < count) {
    for (const uint16_t type : mixture.kinds[random() % mixture.kinds.size()]) {
      words.push_back(static_cast<uint16_t>(type << 12 | (random() & mixture.mask_and)));
    }
  }
  return words;
}

class Evt3CommonWords : public ::testing::TestWithParam<Mixture> {};

TEST_P(Evt3CommonWords, AreDecodedAsWordByWord) {
  std::mt19937 random(7);
  for (const size_t longest : {3, 40, 300, 2000}) {
    for (int round = 0; round < 5; ++round) {
      // Enough for a base to run beyond every sensor.
      const auto words = random_words(GetParam(), 8000, random);
      const Decoded plain = decode_plainly(words);
      const Decoded fast = decode_in_pieces(words, longest, random);
      const auto [a, b] =
          std::mismatch(plain.events.begin(), plain.events.end(), fast.events.begin(), fast.events.end());
      ASSERT_TRUE(a == plain.events.end() && b == fast.events.end())
          << "event " << a - plain.events.begin() << " of " << plain.events.size() << ", pieces of "
          << longest;
      EXPECT_EQ(fast.unknown, plain.unknown);
      EXPECT_EQ(fast.gaps, plain.gaps);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Evt3CommonWords,
    ::testing::Values(
        Mixture{"garbage",
                {{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}, {9}, {10}, {11}, {12}, {13}, {14}, {15}}},
        Mixture{"columns", {{0}, {2}, {2}, {0, 2}, {6}}},
        Mixture{"repeated_times", {{0, 2}, {8}, {8, 6}, {2}}, 0x001},
        Mixture{"sparse_vectors", {{2}, {0, 2}, {3, 4, 4, 5}, {3, 4, 4, 5}, {6, 0}}, 0x911},
        Mixture{"full_vectors", {{0, 3, 4, 4, 5}, {4, 4, 5}, {4, 5}, {2}}},
        Mixture{"vectors_in_any_order", {{3}, {4}, {4}, {5}, {4, 4, 5}, {0}}},
        Mixture{"running_bases", {{4, 4, 5}, {4}, {5}}},
        Mixture{"rows_of_other_events", {{1}, {0}, {2}, {3, 4, 4, 5}, {6}, {8}, {9}}},
        Mixture{"continued", {{14, 15, 15, 7}, {0, 2}, {8, 6}, {10}, {13}}, 0x003}),
    [](const auto& mixture) { return std::string(mixture.param.name); });

TEST(Evt3CommonWordsAlone, StopsBeforeANewTimeHighAndKeepsWhatWasSaid) {
  const Bytes bytes =
      with_words<uint16_t>("", {0x6003, 0x0005, 0x2807, 0x8001, 0xE001, 0x2008, 0x8002, 0x2009});
  std::vector<Event> out(100);
  evt3::Said said{.base = 4096, .high = 1};
  const auto decoded = evt3::decode_common_words(bytes, out, said);
  EXPECT_EQ(decoded.bytes, 12u) << "up to the second TIME_HIGH";
  ASSERT_EQ(decoded.events, 2u);
  EXPECT_EQ(out[0], (Event{4099, 7, 5, 1}));
  EXPECT_EQ(out[1], (Event{4099, 8, 5, 0}));
  EXPECT_EQ(said.low, 3u);
  EXPECT_EQ(said.y, 5u);
}

TEST(Evt3CommonWordsAlone, LeavesThePaddingOfEventsZero) {
  const Bytes bytes = with_words<uint16_t>(
      "", {0x6FFF, 0x0FFF, 0x2FFF, 0x3FFF, 0x4FFF, 0x4FFF, 0x5FFF, 0x6001, 0x6002, 0x6003});
  std::vector<Event> out(100);
  evt3::Said said{.base = 4096, .high = 1};
  const auto decoded = evt3::decode_common_words(bytes, out, said);
  ASSERT_EQ(decoded.events, 33u);
  for (size_t i = 0; i < decoded.events; ++i) EXPECT_THAT(out[i].padding, ::testing::Each(0));
}

}  // namespace
}  // namespace scarf
