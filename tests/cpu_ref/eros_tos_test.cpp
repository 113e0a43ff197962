// EROS and TOS against hand-worked cases, and against their sequential rules in doubles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int64_t kNever = 65'535;
constexpr SensorSize kRow = {5, 1};

// The surface as published: one double per pixel, changed in place by every event.
class SequentialSurface {
 public:
  SequentialSurface(SensorSize sensor, int32_t kernel, std::function<double(double)> fade)
      : sensor_(sensor), reach_(kernel / 2), fade_(std::move(fade)), values_(sensor.width * sensor.height) {}

  static SequentialSurface eros(SensorSize sensor, int32_t k, double d) {
    return {sensor, k, [od = std::pow(d, 1.0 / k)](double v) { return v * od; }};
  }
  static SequentialSurface tos(SensorSize sensor, int32_t k, double decay) {
    return {sensor, k, [low = 255 - k * decay](double v) { return v < low ? 0 : v - 1; }};
  }

  void push(const Event& e) {
    if (!sensor_.contains(e)) return;
    for (int32_t y = 0; y < sensor_.height; ++y) {
      for (int32_t x = 0; x < sensor_.width; ++x) {
        if (std::abs(x - e.x) > reach_ || std::abs(y - e.y) > reach_) continue;
        double& v = values_[static_cast<size_t>(y) * sensor_.width + x];
        v = x == e.x && y == e.y ? 255 : fade_(v);
      }
    }
  }
  std::vector<uint8_t> u8() const {
    std::vector<uint8_t> out;
    for (double v : values_) out.push_back(static_cast<uint8_t>(std::nearbyint(v)));
    return out;
  }
  std::vector<float> f32() const {
    std::vector<float> out;
    for (double v : values_) out.push_back(static_cast<float>(v / 255));
    return out;
  }

 private:
  SensorSize sensor_;
  int32_t reach_;
  std::function<double(double)> fade_;
  std::vector<double> values_;
};

void expect_equal_on_random_streams(const Parameters& parameters,
                                    const std::function<SequentialSurface(SensorSize)>& make) {
  const SensorSize sensor = {23, 17};
  for (Spread spread : kSpreads) {
    SequentialSurface expected = make(sensor);
    const auto r = reference(parameters, sensor);
    const auto events = make_stream(spread, sensor, 1'500, 7 + static_cast<uint64_t>(spread));
    for (size_t i = 0; i < events.size(); i += 500) {
      const std::span<const Event> batch = std::span(events).subspan(i, 500);
      for (const Event& e : batch) expected.push(e);
      ASSERT_TRUE(r->push(batch));
      ASSERT_EQ(u8_of(*r), expected.u8()) << "spread " << static_cast<int>(spread) << " after " << i + 500;
      ASSERT_EQ(float_of(*r), expected.f32()) << "spread " << static_cast<int>(spread);
    }
  }
}

// The pixel beside one that fires n times, itself having fired once before.
std::unique_ptr<Representation> aged(const Parameters& parameters, size_t n) {
  std::vector<Event> events(n + 1, event(0, 1));
  events[0] = event(0, 0);
  return reference(parameters, {2, 1}, events);
}

TEST(Eros, BeforeAnyEvent) {
  const auto r = reference(ErosParameters{}, kRow);
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(float_of(*r), Each(0));
  EXPECT_THAT(raw_of(*r), Each(kNever));
  EXPECT_EQ(value_of(r->state()), std::vector<uint8_t>(10, 0xFF));
}

TEST(Eros, ByHand) {
  // k = 3, d = 0.3: od = 0.3^(1/3) = 0.66943, od^2 = 0.44814.
  const auto r = reference(ErosParameters{.kernel = 3}, kRow, {event(9, 2, 0, 0), event(7, 3, 0, 1)});
  // Pixel 2 was in the window of 3: 255 * 0.66943 = 170.7. Neighbours that never fired stay 0.
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 0, 171, 255, 0));
  EXPECT_THAT(raw_of(*r), ElementsAre(kNever, kNever, 1, 0, kNever));
  EXPECT_EQ(float_of(*r)[2], static_cast<float>(255 * std::pow(0.3, 1.0 / 3) / 255));
  // Pixel 1 fires: 2 ages again (114.28), 3 is out of reach.
  ASSERT_TRUE(r->push(std::vector<Event>{event(8, 1)}));
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 114, 255, 0));
  EXPECT_THAT(raw_of(*r), ElementsAre(kNever, 0, 2, 0, kNever));
  // Pixel 2 fires again: its own age starts over.
  ASSERT_TRUE(r->push(std::vector<Event>{event(8, 2)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(kNever, 1, 0, 1, kNever));
  EXPECT_EQ(value_of(r->state()), StateBytes().add(std::vector<uint16_t>{65'535, 1, 0, 1, 65'535}).bytes());
}

TEST(Eros, WindowsAreClippedAtTheSensor) {
  // All pixels of 4x3 fire in raster order, then the corners (3,0) and (0,2) with windows of 3x3: nothing
  // wraps to the next row.
  std::vector<Event> events;
  for (int32_t y = 0; y < 3; ++y) {
    for (int32_t x = 0; x < 4; ++x) events.push_back(event(0, x, y));
  }
  const auto r = reference(ErosParameters{.kernel = 3}, {4, 3}, events);
  // How many neighbours fired later: the right one and, one row below, up to three.
  EXPECT_THAT(raw_of(*r), ElementsAre(3, 4, 4, 2,  //
                                      3, 4, 4, 2,  //
                                      1, 1, 1, 0));
  ASSERT_TRUE(r->push(std::vector<Event>{event(0, 3, 0), event(0, 0, 2)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(3, 4, 5, 0,  //
                                      4, 5, 5, 3,  //
                                      0, 2, 1, 0));
}

TEST(Eros, PaperDefaults) {
  // 255 * 0.3^(46/9) = 0.543 and 255 * 0.3^(47/9) = 0.475.
  EXPECT_EQ(u8_of(*aged(ErosParameters{}, 46))[0], 1);
  EXPECT_EQ(u8_of(*aged(ErosParameters{}, 47))[0], 0);
  EXPECT_GT(float_of(*aged(ErosParameters{}, 47))[0], 0);
  // The window of k = 9 reaches 4 pixels.
  const auto r = reference(ErosParameters{}, {6, 6}, {event(0, 4, 4), event(0, 5, 0), event(0, 0, 0)});
  EXPECT_EQ(value_of(r->raw_image()).at(4, 4), 2);
  EXPECT_EQ(value_of(r->raw_image()).at(5, 0), 0);
}

TEST(Eros, EqualsTheSequentialRule) {
  for (int32_t k = 3; k <= 13; k += 2) {
    for (double d : {0.05, 0.3, 0.9}) {
      SCOPED_TRACE(testing::Message() << "k " << k << " d " << d);
      expect_equal_on_random_streams(ErosParameters{.kernel = k, .decay = d}, [&](SensorSize sensor) {
        return SequentialSurface::eros(sensor, k, d);
      });
    }
  }
}

TEST(Eros, EvenKernelsAreRaised) {
  expect_equal_on_random_streams(ErosParameters{.kernel = 4},
                                 [](SensorSize sensor) { return SequentialSurface::eros(sensor, 5, 0.3); });
}

TEST(Eros, TheAgeSaturates) {
  const auto before = aged(ErosParameters{}, 65'533);
  EXPECT_EQ(raw_of(*before)[0], 65'533);
  const auto r = aged(ErosParameters{}, 70'000);
  EXPECT_EQ(raw_of(*r)[0], 65'534);
  EXPECT_EQ(u8_of(*r)[0], 0);
  EXPECT_THAT(value_of(r->state()), ElementsAre(0xFE, 0xFF, 0, 0));
  ASSERT_TRUE(r->push(std::vector<Event>{event(0, 0)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(0, 1));
}

TEST(Eros, EventsOutsideDoNotAgePixels) {
  const auto r = reference(ErosParameters{}, kRow, {event(0, 4), event(1, 5), event(1, 4, 1)});
  EXPECT_EQ(raw_of(*r)[4], 0);
}

TEST(Eros, ParametersBelongToTheInstance) {
  const std::vector<Event> events = {event(0, 0), event(0, 2)};
  const auto narrow = reference(ErosParameters{.kernel = 3}, kRow, events);
  const auto wide = reference(ErosParameters{.kernel = 5, .decay = 0.01}, kRow, events);
  EXPECT_THAT(u8_of(*narrow), ElementsAre(255, 0, 255, 0, 0));
  EXPECT_THAT(u8_of(*wide), ElementsAre(102, 0, 255, 0, 0));  // 255 * 0.01^(1/5) = 101.5
  EXPECT_THAT(u8_of(*narrow), ElementsAre(255, 0, 255, 0, 0));
}

TEST(Eros, KeepsNoEvents) {
  const auto events = reference(ErosParameters{}, kRow)->events().wait();
  ASSERT_FALSE(events.ok());
  EXPECT_EQ(events.error().code, ErrorCode::illegal_parameter);
  EXPECT_THAT(events.error().message, HasSubstr("aae"));
}

TEST(Tos, BeforeAnyEvent) {
  const auto r = reference(TosParameters{}, kRow);
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(raw_of(*r), Each(kNever));
}

TEST(Tos, ByHand) {
  // k = 3, decay = 1: below 252 becomes 0. Pixel 0 through four events of its neighbour: 254, 253, 252, 251;
  // the fifth finds 251 < 252.
  const TosParameters parameters = {.kernel = 3, .decay = 1};
  std::vector<int> seen;
  for (size_t n = 0; n <= 6; ++n) seen.push_back(u8_of(*aged(parameters, n))[0]);
  EXPECT_THAT(seen, ElementsAre(255, 254, 253, 252, 251, 0, 0));
  EXPECT_EQ(float_of(*aged(parameters, 4))[0], static_cast<float>(251.0 / 255));
  EXPECT_THAT(raw_of(*aged(parameters, 6)), ElementsAre(6, 0));
}

TEST(Tos, PaperDefaults) {
  // 255 - 9 * 2 = 237: 19 events lead to 236, the 20th to 0.
  EXPECT_EQ(u8_of(*aged(TosParameters{}, 18))[0], 237);
  EXPECT_EQ(u8_of(*aged(TosParameters{}, 19))[0], 236);
  EXPECT_EQ(u8_of(*aged(TosParameters{}, 20))[0], 0);
  EXPECT_EQ(float_of(*aged(TosParameters{}, 20))[0], 0);
}

TEST(Tos, FractionsOfTheThresholdCount) {
  // 255 - 3 * 0.5 = 253.5: 254 is not below it, 253 is.
  const TosParameters half = {.kernel = 3, .decay = 0.5};
  EXPECT_EQ(u8_of(*aged(half, 1))[0], 254);
  EXPECT_EQ(u8_of(*aged(half, 2))[0], 253);
  EXPECT_EQ(u8_of(*aged(half, 3))[0], 0);
  // 255 - 3 * 84.9 = 0.3: 1 is not below it, 0 is, and stays.
  const TosParameters low = {.kernel = 3, .decay = 84.9};
  EXPECT_EQ(u8_of(*aged(low, 254))[0], 1);
  EXPECT_EQ(u8_of(*aged(low, 255))[0], 0);
  EXPECT_EQ(u8_of(*aged(low, 300))[0], 0);
}

TEST(Tos, EqualsTheSequentialRule) {
  for (int32_t k = 3; k <= 13; k += 2) {
    for (double decay : {0.1, 2.0, 7.25, 19.5}) {
      SCOPED_TRACE(testing::Message() << "k " << k << " decay " << decay);
      expect_equal_on_random_streams(TosParameters{.kernel = k, .decay = decay}, [&](SensorSize sensor) {
        return SequentialSurface::tos(sensor, k, decay);
      });
    }
  }
}

TEST(Tos, EvenKernelsAreRaised) {
  // The threshold, too, is that of the raised kernel.
  expect_equal_on_random_streams(TosParameters{.kernel = 4, .decay = 3},
                                 [](SensorSize sensor) { return SequentialSurface::tos(sensor, 5, 3); });
}

TEST(Tos, TheAgeSaturates) {
  const auto r = aged(TosParameters{}, 70'000);
  EXPECT_EQ(raw_of(*r)[0], 65'534);
  EXPECT_EQ(u8_of(*r)[0], 0);
}

TEST(Tos, SharesTheStateOfEros) {
  const SensorSize sensor = {12, 9};
  const auto events = make_stream(Spread::uniform, sensor, 500, 3);
  EXPECT_EQ(value_of(reference(TosParameters{.kernel = 5}, sensor, events)->state()),
            value_of(reference(ErosParameters{.kernel = 5}, sensor, events)->state()));
}

}  // namespace
}  // namespace scarf::test
