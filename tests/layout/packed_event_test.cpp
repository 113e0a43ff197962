#include "layout/packed_event.h"

#include <gtest/gtest.h>

#include <limits>

namespace scarf {
namespace {

constexpr int64_t kFar = (int64_t{1} << 48) - 1;  // the largest distance to the first event

Event event(int64_t t, int32_t x, int32_t y, uint8_t p) {
  return {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), p};
}

TEST(PackedEvent, EachFieldHasItsBits) {
  EXPECT_EQ(pack(event(0, 127, 0, 0), 0, 0, 0), uint64_t{127});
  EXPECT_EQ(pack(event(0, 0, 127, 0), 0, 0, 0), uint64_t{127} << 7);
  EXPECT_EQ(pack(event(0, 0, 0, 1), 0, 0, 0), uint64_t{1} << 14);
  EXPECT_EQ(pack(event(1, 0, 0, 0), 0, 0, 0), uint64_t{1} << 15);
  EXPECT_EQ(pack(event(-1, 0, 0, 0), 0, 0, 0), ~uint64_t{0} << 15);
  EXPECT_EQ(pack(event(kFar, 127, 127, 1), 0, 0, 0), ~uint64_t{0} >> 1);
}

TEST(PackedEvent, RoundTripAtAllExtremes) {
  constexpr int64_t kMax = std::numeric_limits<int64_t>::max();
  constexpr int64_t kMin = std::numeric_limits<int64_t>::min();
  for (const int64_t t_first : {int64_t{0}, int64_t{-1}, int64_t{1} << 51, kMax - kFar, kMin + kFar}) {
    for (const int64_t distance : {-kFar, int64_t{-1}, int64_t{0}, int64_t{1}, kFar}) {
      for (const auto& [x, field_x] : {std::pair{0, 0}, {0, -127}, {16383, 16383}, {16383, 16256}, {5, -2}}) {
        for (const auto& [y, field_y] : {std::pair{0, 0}, {0, -127}, {16383, 16256}}) {
          for (const uint8_t p : {uint8_t{0}, uint8_t{1}}) {
            const Event e = event(t_first + distance, x, y, p);
            ASSERT_EQ(unpack(pack(e, field_x, field_y, t_first), field_x, field_y, t_first), e)
                << "t_first " << t_first << " distance " << distance << " x " << x << " y " << y;
          }
        }
      }
    }
  }
}

TEST(PackedEvent, TimesAtTheEndsOfTheirRange) {
  constexpr int64_t kMax = std::numeric_limits<int64_t>::max();
  constexpr int64_t kMin = std::numeric_limits<int64_t>::min();
  for (const auto& [t_first, t] :
       {std::pair{kMax, kMax - kFar}, {kMax, kMax}, {kMin, kMin + kFar}, {kMin, kMin}}) {
    const Event e = event(t, 3, 4, 1);
    EXPECT_EQ(unpack(pack(e, 0, 0, t_first), 0, 0, t_first), e);
  }
}

}  // namespace
}  // namespace scarf
