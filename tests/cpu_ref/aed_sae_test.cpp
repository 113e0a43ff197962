// AED-SAE: its list and times by hand, its picture by hand on 3x3 pixels and by plain sums of its definition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr SensorSize kRow = {4, 1};
constexpr SensorSize kSquare = {3, 3};
constexpr int64_t kNone = kNeverFired;

std::vector<uint8_t> state_bytes(int64_t t_max, const std::vector<int64_t>& last,
                                 const std::vector<Event>& listed) {
  return StateBytes().add(t_max).add(last).add(uint64_t{listed.size()}).add(listed).bytes();
}

TEST(AedSae, BeforeAnyEvent) {
  const auto r = reference(AedSaeParameters{}, kSquare);
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(float_of(*r), Each(0));
  EXPECT_THAT(raw_of(*r), Each(kNone));
  EXPECT_EQ(value_of(r->state()), state_bytes(kNone, std::vector<int64_t>(9, kNone), {}));
}

TEST(AedSae, TheListHoldsTheLastTimeSpan) {
  const AedSaeParameters parameters = {.window = 1'000};
  auto r = reference(parameters, kRow, {event(0, 0), event(500, 1), event(1'000, 2)});
  // t >= 1,000 - 1,000: all.
  EXPECT_EQ(value_of(r->state()),
            state_bytes(1'000, {0, 500, 1'000, kNone}, {event(0, 0), event(500, 1), event(1'000, 2)}));
  // The event at 0 leaves; its pixel keeps its time.
  ASSERT_TRUE(r->push(std::vector<Event>{event(1'001, 3, 0, 0)}));
  EXPECT_EQ(value_of(r->state()), state_bytes(1'001, {0, 500, 1'000, 1'001},
                                              {event(500, 1), event(1'000, 2), event(1'001, 3, 0, 0)}));
}

TEST(AedSae, LateEventsLeaveFromTheMiddle) {
  const AedSaeParameters parameters = {.window = 1'000};
  // 600 is not older than the front, 100. At t_max = 1,650 what is before 650 leaves: 100 and 600.
  const auto r = reference(parameters, kRow, {event(100, 0), event(900, 1), event(600, 2), event(1'650, 3)});
  EXPECT_EQ(value_of(r->state()),
            state_bytes(1'650, {100, 900, 600, 1'650}, {event(900, 1), event(1'650, 3)}));
}

TEST(AedSae, AnEventBeforeTheFrontStartsAnew) {
  auto r = reference(AedSaeParameters{}, kRow, {event(10, 0), event(20, 1), event(10, 2), event(15, 2)});
  // As old as the front is not older; t_max stays.
  EXPECT_EQ(value_of(r->state()),
            state_bytes(20, {10, 20, 15, kNone}, {event(10, 0), event(20, 1), event(10, 2), event(15, 2)}));
  ASSERT_TRUE(r->push(std::vector<Event>{event(9, 3)}));
  EXPECT_EQ(value_of(r->state()), state_bytes(9, {kNone, kNone, kNone, 9}, {event(9, 3)}));
  EXPECT_THAT(raw_of(*r), ElementsAre(kNone, kNone, kNone, 9));
  ASSERT_TRUE(r->push(std::vector<Event>{event(12, 0)}));
  EXPECT_EQ(value_of(r->state()), state_bytes(12, {12, kNone, kNone, 9}, {event(9, 3), event(12, 0)}));
}

TEST(AedSae, TheFrontMovesWithTheList) {
  // At 1,400 the list begins with 500; 450 is older than that.
  const AedSaeParameters parameters = {.window = 1'000};
  const auto r = reference(parameters, kRow, {event(0, 0), event(500, 1), event(1'400, 2), event(450, 3)});
  EXPECT_EQ(value_of(r->state()), state_bytes(450, {kNone, kNone, kNone, 450}, {event(450, 3)}));
}

TEST(AedSae, EventsOutsideAreDropped) {
  const auto r = reference(AedSaeParameters{}, kRow, {event(10, 0), event(99, 4), event(5, 0, 1)});
  EXPECT_EQ(value_of(r->state()), state_bytes(10, {10, kNone, kNone, kNone}, {event(10, 0)}));
}

// 3x3 pixels by hand. Kernel of length 3, sigma 1: 0.2741, 0.4519, 0.2741. max(G) - G is 0 in the centre, e =
// 0.0803 beside it and c = 0.1291 in the corners. The four quadrants of one pixel move, the rest stays:
//   0 e c
//   e c e
//   c e c
// The inverse transform of this for one event at (0,0), real part: 4e + 4c = 0.838 at (0,0); -0.105 at (1,0),
// (2,0), (0,1), (0,2); -0.178 at (1,1), (2,2); -0.032 at (1,2), (2,1). Several events add up, shifted.
TEST(AedSae, PictureByHand) {
  // One event: C = 1, n = 1.
  EXPECT_THAT(u8_of(*reference(AedSaeParameters{}, kSquare, {event(0, 0, 0)})),
              ElementsAre(255, 0, 0, 0, 0, 0, 0, 0, 0));
  // (0,0) and (1,1): 0.838 - 0.178 at both, less than 0 elsewhere; C = 2, n = 2, T = 0.3 * 0.3 s * 2/2 = 90
  // ms. Age 81 ms: exp(-0.9^6) = 0.58776, times 255 is 149.88.
  const std::vector<Event> two = {event(0, 0, 0), event(81'000, 1, 1)};
  const auto r = reference(AedSaeParameters{}, kSquare, two);
  EXPECT_THAT(u8_of(*r), ElementsAre(150, 0, 0, 0, 255, 0, 0, 0, 0));
  EXPECT_NEAR(float_of(*r)[0], 0.587757, 1e-6);
  // The same pixel once more: C = 2, n = 3, T = 60 ms. exp(-1.35^6) = 0.00235, times 255 is 0.599.
  ASSERT_TRUE(r->push(std::vector<Event>{event(81'000, 1, 1, 0)}));
  EXPECT_THAT(u8_of(*r), ElementsAre(1, 0, 0, 0, 255, 0, 0, 0, 0));
  EXPECT_NEAR(float_of(*r)[0], 0.002350, 1e-6);
  // Twice the lambda, T = 180 ms and age 81 ms: exp(-0.45^6) = 0.99173, times 255 is 252.89. The list spans
  // the other parameter: with 81 ms and lambda 1 T = 81 ms, exp(-1) * 255 = 93.8.
  EXPECT_EQ(u8_of(*reference(AedSaeParameters{.lambda = 0.6}, kSquare, two))[0], 253);
  EXPECT_EQ(u8_of(*reference(AedSaeParameters{.window = 81'000, .lambda = 1}, kSquare, two))[0], 94);
}

TEST(AedSae, WithoutDensityOnlyTheNewestTimeShows) {
  // Kernel of length 2: 0.5, 0.5; G is flat, so nothing remains and C = 0.
  const auto r = reference(AedSaeParameters{}, {2, 2}, {event(4, 0, 0), event(5, 1, 0), event(5, 0, 1)});
  EXPECT_THAT(u8_of(*r), ElementsAre(0, 255, 255, 0));
  EXPECT_THAT(float_of(*r), ElementsAre(0, 1, 1, 0));
  // One pixel is flat as well.
  EXPECT_THAT(u8_of(*reference(AedSaeParameters{}, {1, 1}, {event(4, 0)})), ElementsAre(255));
  // Every pixel fired: only the mean is left of the spectrum, which is multiplied by 0.
  std::vector<Event> all;
  for (int32_t i = 0; i < 24; ++i) all.push_back(event(i, i % 6, i / 6));
  std::vector<uint8_t> newest(24, 0);
  newest[23] = 255;
  EXPECT_EQ(u8_of(*reference(AedSaeParameters{}, {6, 4}, all)), newest);
}

// The definition with plain sums instead of fast transforms.
std::vector<double> kernel(int32_t length) {
  const double sigma = length / 2;
  std::vector<double> g(length, 1);
  double sum = 0;
  for (int32_t i = 0; i < length; ++i) {
    const double d = i - (length - 1) / 2.0;
    if (sigma > 0) g[i] = std::exp(-d * d / (2 * sigma * sigma));
    sum += g[i];
  }
  for (double& v : g) v /= sum;
  return g;
}

// Max(G) - G for the frequency (u, v), after the quadrants have changed places; an odd last row or column is
// in no quadrant and stays.
double filter(const std::vector<double>& gx, const std::vector<double>& gy, size_t u, size_t v) {
  const double peak = *std::max_element(gx.begin(), gx.end()) * *std::max_element(gy.begin(), gy.end());
  const size_t half_x = gx.size() / 2;
  const size_t half_y = gy.size() / 2;
  if (u < 2 * half_x && v < 2 * half_y) {
    u = (u + half_x) % (2 * half_x);
    v = (v + half_y) % (2 * half_y);
  }
  return peak - gx[u] * gy[v];
}

// The number of pixels with b > 0.001.
int64_t bright_pixels(SensorSize sensor, const std::vector<Event>& listed) {
  const int32_t w = sensor.width;
  const int32_t h = sensor.height;
  std::vector<double> image(static_cast<size_t>(w) * h);
  for (const Event& e : listed) image[static_cast<size_t>(e.y) * w + e.x] = 1;
  const auto gx = kernel(w);
  const auto gy = kernel(h);
  const auto wave = [&](double sign, int32_t u, int32_t v, int32_t x, int32_t y) {
    return std::polar(1.0, sign * 2 * std::numbers::pi *
                               (static_cast<double>(u * x % w) / w + static_cast<double>(v * y % h) / h));
  };
  std::vector<std::complex<double>> spectrum(image.size());
  for (int32_t v = 0; v < h; ++v) {
    for (int32_t u = 0; u < w; ++u) {
      std::complex<double> f = 0;
      for (int32_t y = 0; y < h; ++y) {
        for (int32_t x = 0; x < w; ++x) f += image[static_cast<size_t>(y) * w + x] * wave(-1, u, v, x, y);
      }
      spectrum[static_cast<size_t>(v) * w + u] = f * filter(gx, gy, u, v);
    }
  }
  int64_t count = 0;
  for (int32_t y = 0; y < h; ++y) {
    for (int32_t x = 0; x < w; ++x) {
      double b = 0;
      for (int32_t v = 0; v < h; ++v) {
        for (int32_t u = 0; u < w; ++u) {
          b += (spectrum[static_cast<size_t>(v) * w + u] * wave(1, u, v, x, y)).real();
        }
      }
      EXPECT_GT(std::abs(b - 0.001), 1e-9) << "too close to tell";
      count += b > 0.001;
    }
  }
  return count;
}

struct Model {
  SensorSize sensor;
  AedSaeParameters parameters;
  std::vector<Event> listed;
  std::vector<int64_t> last;
  int64_t t_max = kNone;

  Model(SensorSize s, const AedSaeParameters& p)
      : sensor(s), parameters(p), last(static_cast<size_t>(s.width) * s.height, kNone) {}

  void push(const Event& e) {
    if (!sensor.contains(e)) return;
    if (!listed.empty() && e.t < listed.front().t) {
      listed.clear();
      last.assign(last.size(), kNone);
      t_max = kNone;
    }
    t_max = std::max(t_max, e.t);
    last[static_cast<size_t>(e.y) * sensor.width + e.x] = e.t;
    listed.push_back(e);
    std::erase_if(listed, [&](const Event& l) { return l.t < t_max - parameters.window; });
  }

  std::vector<double> picture() const {
    std::vector<double> out(last.size());
    const auto n = static_cast<double>(listed.size());
    const auto c = static_cast<double>(bright_pixels(sensor, listed));
    const double span = parameters.lambda * static_cast<double>(parameters.window) * c / n;
    for (size_t i = 0; i < out.size(); ++i) {
      if (last[i] == kNone) continue;
      const auto age = static_cast<double>(t_max - last[i]);
      out[i] = c == 0 ? age == 0 : std::exp(-std::pow(age / span, 6));
    }
    return out;
  }
};

void expect_picture(const Model& model, Representation& r) {
  const auto expected = model.picture();
  const auto levels = float_of(r);
  const auto bytes = u8_of(r);
  for (size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(levels[i], expected[i], 1e-6) << "pixel " << i;
    ASSERT_NEAR(bytes[i], 255 * expected[i], 0.5 + 1e-6) << "pixel " << i;
  }
}

TEST(AedSae, OneEventAnywhere) {
  // An older event elsewhere makes the time scale visible.
  for (const SensorSize sensor : {SensorSize{8, 6}, {7, 5}, {8, 5}, {7, 6}, {1, 6}, {5, 1}, {3, 2}}) {
    SCOPED_TRACE(testing::Message() << sensor.width << "x" << sensor.height);
    for (int32_t y = 0; y < sensor.height; ++y) {
      for (int32_t x = 0; x < sensor.width; ++x) {
        Model model(sensor, {});
        const std::vector<Event> events = {event(0, x, y), event(30'000, sensor.width - 1, sensor.height - 1),
                                           event(80'000, 0, 0)};
        for (const Event& e : events) model.push(e);
        ASSERT_NO_FATAL_FAILURE(expect_picture(model, *reference(AedSaeParameters{}, sensor, events)));
      }
    }
  }
}

TEST(AedSae, RandomStreams) {
  for (const SensorSize sensor : {SensorSize{12, 8}, {11, 9}, {13, 6}}) {
    for (Spread spread : kSpreads) {
      SCOPED_TRACE(testing::Message()
                   << sensor.width << "x" << sensor.height << " spread " << static_cast<int>(spread));
      // Some 30 events in the list; an odd factor makes the steps of time 1.5 ms on average.
      const AedSaeParameters parameters = {.window = 50'000, .lambda = 1.5};
      auto events = make_stream(spread, sensor, 240, 23 + static_cast<uint64_t>(spread));
      for (size_t i = 0; i < events.size(); ++i) events[i].t = events[i].t * 1'501 - (i >= 160 ? 150'000 : 0);
      Model model(sensor, parameters);
      const auto r = reference(parameters, sensor);
      for (size_t i = 0; i < events.size(); ++i) {
        model.push(events[i]);
        ASSERT_TRUE(r->push(std::span(events).subspan(i, 1)));
        if (i % 40 != 39) continue;
        ASSERT_EQ(value_of(r->state()), state_bytes(model.t_max, model.last, model.listed));
        if (!model.listed.empty()) {
          ASSERT_NO_FATAL_FAILURE(expect_picture(model, *r));
        }
      }
    }
  }
}

TEST(AedSae, ParametersBelongToTheInstance) {
  const std::vector<Event> events = {event(0, 0, 0), event(81'000, 1, 1)};
  const auto paper = reference(AedSaeParameters{}, kSquare, events);
  const auto wide = reference(AedSaeParameters{.lambda = 0.6}, kSquare, events);
  EXPECT_EQ(u8_of(*paper)[0], 150);
  EXPECT_EQ(u8_of(*wide)[0], 253);
  EXPECT_EQ(u8_of(*paper)[0], 150);
}

TEST(AedSae, KeepsNoEvents) {
  const auto events = reference(AedSaeParameters{}, kRow)->events().wait();
  ASSERT_FALSE(events.ok());
  EXPECT_THAT(events.error().message, HasSubstr("aae"));
}

}  // namespace
}  // namespace scarf::test
