// The time surface, worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/representations.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr SensorSize kRow = {4, 1};
constexpr int64_t kMin = std::numeric_limits<int64_t>::min();
constexpr int64_t kMax = std::numeric_limits<int64_t>::max();
constexpr auto kLinear = SaeParameters::Decay::linear;

std::unique_ptr<Representation> exponential(int64_t tau, const std::vector<Event>& events) {
  return reference(SaeParameters{.tau = tau}, kRow, events);
}
std::unique_ptr<Representation> linear(int64_t tau, const std::vector<Event>& events) {
  return reference(SaeParameters{.decay = kLinear, .tau = tau}, kRow, events);
}

// The float of a pixel that is `age` old.
float at_age(int64_t tau, int64_t age) {
  return float_of(*exponential(tau, {event(0, 0)}), age)[0];
}

TEST(Sae, BeforeAnyEvent) {
  for (const auto& r : {exponential(33'000, {}), linear(33'000, {})}) {
    EXPECT_THAT(u8_of(*r), Each(0));
    EXPECT_THAT(u8_of(*r, kMin), Each(0));
    EXPECT_THAT(float_of(*r, kMax), Each(0));
    const Image<int64_t> raw = value_of(r->raw_image());
    EXPECT_EQ(raw.planes, 2);
    EXPECT_EQ(raw.pixels, std::vector<int64_t>(8, kNeverFired));
    EXPECT_EQ(value_of(r->state()), StateBytes().add(std::vector<int64_t>(9, kNeverFired)).bytes());
  }
}

TEST(Sae, StepsOfFourMicrosecondsByDefault) {
  // tau = 33,000 and step = 33,000 / 8,192 = 4. Ages 8, 4, 3, 0 fall in the steps 2, 1, 0, 0.
  const auto r = reference(SaeParameters{}, kRow, {event(0, 0), event(4, 1), event(5, 2), event(8, 3)});
  EXPECT_THAT(float_of(*r), ElementsAre(static_cast<float>(std::exp(-8.0 / 33'000)),
                                        static_cast<float>(std::exp(-4.0 / 33'000)), 1, 1));
  EXPECT_THAT(u8_of(*r), Each(255));
}

TEST(Sae, Brightness) {
  // Ages 66,000, 33,000, 16,500, 0: exp(-2) = 0.1353, exp(-1) = 0.3679, exp(-0.5) = 0.6065, times 255 are
  // 34.5105, 93.8, 154.7.
  const auto r =
      reference(SaeParameters{}, kRow, {event(0, 0), event(33'000, 1), event(49'500, 2), event(66'000, 3)});
  EXPECT_THAT(u8_of(*r), ElementsAre(35, 94, 155, 255));
  EXPECT_THAT(float_of(*r),
              ElementsAre(static_cast<float>(std::exp(-2.0)), static_cast<float>(std::exp(-1.0)),
                          static_cast<float>(std::exp(-0.5)), 1));
}

TEST(Sae, NothingFromEightTauOn) {
  // 263,999 / 4 = 65,999, and 65,999 * 4 = 263,996.
  EXPECT_EQ(at_age(33'000, 263'999), static_cast<float>(std::exp(-263'996.0 / 33'000)));
  EXPECT_EQ(at_age(33'000, 264'000), 0);
  EXPECT_EQ(at_age(33'000, int64_t{1} << 40), 0);
  EXPECT_EQ(at_age(1, 0), 1);
  EXPECT_EQ(at_age(1, 7), static_cast<float>(std::exp(-7.0)));
  EXPECT_EQ(at_age(1, 8), 0);
}

TEST(Sae, TheStepFollowsTau) {
  EXPECT_LT(at_age(8'191, 1), 1);   // 8,191 / 8,192 = 0, raised to 1
  EXPECT_LT(at_age(16'383, 1), 1);  // step 1
  EXPECT_EQ(at_age(16'384, 1), 1);  // step 2
  EXPECT_LT(at_age(16'384, 2), 1);
  EXPECT_EQ(at_age(10'000'000, 1'219), 1);  // step 1,220
  EXPECT_EQ(at_age(10'000'000, 1'220), static_cast<float>(std::exp(-1'220.0 / 10'000'000)));
}

TEST(Sae, TheNewerOfBothPolaritiesIsShown) {
  // Pixel 0: OFF at 1,000, ON at 500 arrives later; pixel 1: the other way round.
  const std::vector<Event> events = {event(1'000, 0, 0, 0), event(500, 0, 0, 1), event(1'000, 1, 0, 1),
                                     event(500, 1, 0, 0), event(1'100, 2)};
  const auto r = linear(200, events);
  EXPECT_THAT(u8_of(*r), ElementsAre(128, 128, 255, 0));  // age 100 of 200: 127.5, half to even
  EXPECT_THAT(raw_of(*r), ElementsAre(1'000, 500, kNeverFired, kNeverFired, 500, 1'000, 1'100, kNeverFired));
}

TEST(Sae, TheLastTimeIsTheLastToArrive) {
  const auto r = linear(100, {event(100, 0), event(50, 0), event(100, 1)});
  EXPECT_THAT(u8_of(*r), ElementsAre(128, 255, 0, 0));  // age 50, not 0
  EXPECT_EQ(value_of(r->state()), StateBytes()
                                      .add(int64_t{100})
                                      .add(std::vector<int64_t>(4, kNeverFired))
                                      .add(std::vector<int64_t>{50, 100, kNeverFired, kNeverFired})
                                      .bytes());
}

TEST(Sae, NewestIsTheLastToArrive) {
  // T = 50: pixel 0 lies 50 ahead, which counts as age 0; pixel 1 is 50 old.
  const auto r = linear(100, {event(0, 1), event(100, 0), event(50, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 128, 255, 0));
}

TEST(Sae, AtAGivenTime) {
  const auto r = linear(100, {event(0, 0), event(50, 1)});
  EXPECT_THAT(u8_of(*r, 100), ElementsAre(0, 128, 0, 0));
  EXPECT_THAT(u8_of(*r, -1'000), ElementsAre(255, 255, 0, 0));
  EXPECT_THAT(u8_of(*r), ElementsAre(128, 255, 0, 0));
}

TEST(Sae, EventsOutsideDoNotMoveTheTime) {
  const auto r = linear(100, {event(0, 0), event(1'000, 4), event(2'000, 0, 1)});
  EXPECT_THAT(u8_of(*r), ElementsAre(255, 0, 0, 0));
}

TEST(SaeLinear, TheByteComesFromTheDouble) {
  // Age 90 of 100: 1 - 0.9 is a little less than 0.1, so 25.4999... becomes 25. The float is a little more
  // than 0.1 and would give 26.
  const auto r = linear(100, {event(1, 0), event(10, 1), event(41, 2), event(100, 3)});
  EXPECT_THAT(u8_of(*r), ElementsAre(3, 25, 105, 255));  // 0.01, 0.1, 0.41 (104.55)
  EXPECT_THAT(float_of(*r), ElementsAre(static_cast<float>(1 - 0.99), static_cast<float>(1 - 0.9),
                                        static_cast<float>(1 - 0.59), 1));
}

TEST(SaeLinear, HalvesGoToTheEvenByte) {
  // Age 3 of 10: 255 * 0.7 = 178.5; age 5: 127.5.
  const auto r = linear(10, {event(0, 0), event(2, 1), event(5, 2)});
  EXPECT_THAT(u8_of(*r), ElementsAre(128, 178, 255, 0));
}

TEST(SaeLinear, NothingFromTauOn) {
  const auto r = linear(100, {event(0, 0), event(1, 1), event(100, 2)});
  EXPECT_EQ(float_of(*r)[0], 0);
  EXPECT_GT(float_of(*r)[1], 0);
  EXPECT_EQ(float_of(*r, 101)[1], 0);
  const auto tiny = linear(1, {event(0, 0), event(1, 1)});
  EXPECT_THAT(float_of(*tiny), ElementsAre(0, 1, 0, 0));
}

TEST(Sae, TheEndsOfTime) {
  for (const auto decay : {SaeParameters::Decay::exponential, kLinear}) {
    const SaeParameters parameters = {.decay = decay};
    const auto early = reference(parameters, kRow, {event(kMin + 5, 0)});
    EXPECT_THAT(u8_of(*early), ElementsAre(255, 0, 0, 0));
    EXPECT_THAT(u8_of(*early, kMin), ElementsAre(255, 0, 0, 0));
    EXPECT_THAT(u8_of(*early, kMax), Each(0));
    const auto late = reference(parameters, kRow, {event(kMax, 0)});
    EXPECT_THAT(u8_of(*late, kMin), ElementsAre(255, 0, 0, 0));
  }
}

TEST(Sae, ParametersBelongToTheInstance) {
  const std::vector<Event> events = {event(0, 0), event(100, 1)};
  const auto slow = linear(200, events);
  const auto fast = linear(100, events);
  EXPECT_THAT(u8_of(*slow), ElementsAre(128, 255, 0, 0));
  EXPECT_THAT(u8_of(*fast), ElementsAre(0, 255, 0, 0));
  EXPECT_THAT(u8_of(*slow), ElementsAre(128, 255, 0, 0));
}

TEST(Sae, KeepsNoEvents) {
  const auto events = exponential(100, {event(0, 0)})->events().wait();
  ASSERT_FALSE(events.ok());
  EXPECT_THAT(events.error().message, HasSubstr("aae"));
}

}  // namespace
}  // namespace scarf::test
