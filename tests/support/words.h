// Words for tests of the decoders, and what the reader of their format makes of them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "io/open/open.h"
#include "scarf/device/decoder.h"
#include "tests/support/same.h"

namespace scarf::test {

using Bytes = std::vector<uint8_t>;

/// std::mt19937 whose numbers have 32 bits by type, too.
struct Random {
  explicit Random(uint32_t seed) : engine(seed) {}
  uint32_t operator()() { return static_cast<uint32_t>(engine()); }
  std::mt19937 engine;
};

struct Read {
  std::vector<Event> events;
  ReadReport report;
};

inline Read read_words(CameraWords words, const Bytes& bytes, SensorSize sensor) {
  const std::string format = words == CameraWords::evt2 ? "evt2" : "evt3";
  const auto source =
      value_of(open_input(ByteReader::over(bytes), "test", {.sensor = sensor, .format = format}));
  Read read;
  std::vector<Event> some(1000);
  for (;;) {
    const size_t n = value_of(source->read(some));
    if (n == 0) break;
    read.events.insert(read.events.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(n));
  }
  read.report = source->report();
  return read;
}

template <class Word>
void append_word(Bytes& bytes, Word word) {
  for (size_t i = 0; i < sizeof(Word); ++i) bytes.push_back(static_cast<uint8_t>(word >> (8 * i)));
}
inline void append_word(CameraWords words, Bytes& bytes, uint32_t word) {
  if (words == CameraWords::evt2) return append_word<uint32_t>(bytes, word);
  append_word<uint16_t>(bytes, static_cast<uint16_t>(word));
}

/// How words of a random stream are chosen.
enum class Mixture {
  garbage,    ///< any bits
  plausible,  ///< mostly events, a clock that moves on
  wraps,      ///< half of the words are TIME_HIGH of any value, many repeated
  skips,      ///< IMU words everywhere (EVT2); rows of other events (EVT3)
  vectors,    ///< vectors that run on (EVT3)
};
inline constexpr Mixture kMixtures[] = {Mixture::garbage, Mixture::plausible, Mixture::wraps, Mixture::skips,
                                        Mixture::vectors};

inline Bytes random_words(CameraWords format, Mixture mixture, size_t count, uint32_t seed) {
  Random random(seed);
  const bool evt2 = format == CameraWords::evt2;
  const int type_shift = evt2 ? 28 : 12;
  const uint32_t payload = (1u << type_shift) - 1;
  Bytes bytes;
  uint32_t high = random() & payload;
  const auto pick = [&](std::initializer_list<uint32_t> types) {
    return *(types.begin() + random() % types.size());
  };
  for (size_t i = 0; i < count; ++i) {
    const auto bits = random();
    uint32_t type = bits >> 28;
    uint32_t low = (random() ^ bits << 3) & payload;
    switch (mixture) {
      case Mixture::garbage:
        break;
      case Mixture::plausible:
        type =
            evt2 ? pick({0, 1, 0, 1, 0, 1, 8, 0xA, 0xE}) : pick({0, 2, 2, 2, 3, 4, 4, 5, 6, 8, 0xE, 0xF, 7});
        if (type == 8) low = high = (high + (bits & 1)) & payload;
        break;
      case Mixture::wraps:
        type = evt2 ? pick({0, 1, 8, 8}) : pick({2, 2, 6, 8, 8, 8});
        if (type == 8) low = high = (bits & 1) != 0 ? high : random() & payload;
        break;
      case Mixture::skips:
        type = evt2 ? pick({0, 1, 8, 0xD, 0xD, 0xD, 5}) : pick({0, 1, 1, 2, 4, 5, 8, 0x9, 0xB});
        if (type == 9) low = 0x999 + (bits & 1);
        break;
      case Mixture::vectors:
        type = evt2 ? pick({0, 1}) : pick({4, 4, 4, 5, 4, 4, 4, 5, 3});
        if (type == 3 && (bits & 7) != 0) type = 6;
        if (!evt2 && i % 1000 == 0) type = 0;
        break;
    }
    if (i == 3 && mixture != Mixture::garbage) type = 8;
    append_word(format, bytes, type << type_shift | low);
  }
  return bytes;
}

}  // namespace scarf::test
