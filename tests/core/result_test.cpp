#include "scarf/core/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "scarf/core/pending.h"

namespace scarf {
namespace {

const Error kError{ErrorCode::bad_input, "no number"};

Result<int> number(bool good) {
  if (good) return 7;
  return kError;
}

TEST(Result, MapsValuesAndKeepsErrors) {
  EXPECT_EQ(*number(true).map([](int n) { return std::to_string(n); }), "7");
  EXPECT_EQ(number(false).map([](int n) { return n + 1; }).error().message, "no number");
  EXPECT_EQ(*number(true).and_then([](int n) { return Result<int>(n + 1); }), 8);
  EXPECT_EQ(number(true).and_then([](int) { return number(false); }).error().code, ErrorCode::bad_input);
  EXPECT_EQ(number(true).value_or(3), 7);
  EXPECT_EQ(number(false).value_or(3), 3);
}

TEST(Result, MovesValuesThatCannotBeCopied) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(5);
  const auto doubled =
      std::move(made).map([](std::unique_ptr<int> n) { return std::make_unique<int>(2 * *n); });
  EXPECT_EQ(**doubled, 10);
}

TEST(ResultDeathTest, AValueThatIsNoneEndsTheProgram) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(static_cast<void>(*number(false)), "");
  EXPECT_DEATH(static_cast<void>(number(false).value()), "");
  EXPECT_DEATH(static_cast<void>(number(true).error()), "");
}

TEST(Pending, IsHandedOverOnce) {
  Pending<int> pending(7);
  EXPECT_EQ(*pending.wait(), 7);
  const auto again = pending.wait();
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().code, ErrorCode::illegal_parameter);
}

}  // namespace
}  // namespace scarf
