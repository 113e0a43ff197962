#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scarf/core/image.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Levels, DefaultAccumulation) {
  const auto levels = make_levels(0.3, 6);
  ASSERT_TRUE(levels.ok());
  EXPECT_THAT(levels->u8, ElementsAre(0, 76, 153, 230, 255, 255, 255));
  EXPECT_THAT(levels->f32, ElementsAre(0.0f, 0.3f, 0.6f, 0.9f, 1.2f, 1.5f, 1.8f));
}

TEST(Levels, HalvesGoToEven) {
  // 255 * c = 2.5 and 0.5 exactly: the products of halves with integers are exact.
  const auto two_and_a_half = make_levels(2.5 / 255.0, 5);
  ASSERT_TRUE(two_and_a_half.ok());
  ASSERT_EQ(255.0 * (2.5 / 255.0), 2.5);
  EXPECT_THAT(two_and_a_half->u8, ElementsAre(0, 2, 5, 8, 10, 12));  // 0, 2.5, 5, 7.5, 10, 12.5

  const auto half = make_levels(0.5 / 255.0, 7);
  ASSERT_TRUE(half.ok());
  ASSERT_EQ(255.0 * (0.5 / 255.0), 0.5);
  EXPECT_THAT(half->u8, ElementsAre(0, 0, 1, 2, 2, 2, 3, 4));  // 0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5
}

TEST(Levels, LastValueBeforeTheClip) {
  const auto levels = make_levels(254.5 / 255.0, 1);
  ASSERT_TRUE(levels.ok());
  EXPECT_THAT(levels->u8, ElementsAre(0, 254));
}

TEST(Levels, FloatIsTheRoundedDoubleProduct) {
  const auto levels = make_levels(0.1, 1000);
  ASSERT_TRUE(levels.ok());
  ASSERT_EQ(levels->f32.size(), 1001u);
  for (int32_t n = 0; n <= 1000; ++n)
    ASSERT_EQ(levels->f32[n], static_cast<float>(0.1 * static_cast<double>(n)));
}

TEST(Levels, OneEntryPerCount) {
  const auto levels = make_levels(1.0, 65535);
  ASSERT_TRUE(levels.ok());
  EXPECT_EQ(levels->u8.size(), 65536u);
  EXPECT_EQ(levels->f32.size(), 65536u);
  EXPECT_EQ(levels->f32.back(), 65535.0f);
}

TEST(Levels, RefusesIllegalAccumulation) {
  const std::pair<double, const char*> cases[] = {
      {0.0, "is 0"},
      {-0.3, "is -0.3"},
      {std::numeric_limits<double>::quiet_NaN(), "is nan"},
      {std::numeric_limits<double>::infinity(), "is inf"},
  };
  for (const auto& [c, value] : cases) {
    const auto levels = make_levels(c, 3);
    ASSERT_FALSE(levels.ok()) << c;
    EXPECT_EQ(levels.error().code, ErrorCode::illegal_parameter);
    EXPECT_THAT(levels.error().message,
                AllOf(HasSubstr("accumulation"), HasSubstr(value), HasSubstr("finite number > 0")));
  }
}

TEST(Levels, NoEventIsBlackForEveryLegalAccumulation) {
  for (const double c : {1e-300, 1.0, 1e300, std::numeric_limits<double>::max()}) {
    const auto levels = make_levels(c, 1);
    ASSERT_TRUE(levels.ok());
    EXPECT_EQ(levels->u8[0], 0) << c;
    EXPECT_EQ(levels->f32[0], 0.0f) << c;
  }
}

}  // namespace
}  // namespace scarf
