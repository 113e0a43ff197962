// Noise filters on the device against the reference filters in front of the reference representations.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

const std::vector<FilterParameters> kSupport = {SupportFilter{.range = 1, .period = 40}};
const std::vector<FilterParameters> kRefractory = {RefractoryFilter{.period = 60}};
const std::vector<FilterParameters> kBoth = {SupportFilter{.range = 2, .period = 30},
                                             RefractoryFilter{.period = 25}};
const std::vector<FilterParameters> kThree = {RefractoryFilter{.period = 9},
                                              SupportFilter{.range = 3, .period = 20},
                                              SupportFilter{.range = 1, .period = 300}};
const std::vector<FilterParameters> kFarReaching = {SupportFilter{.range = 7, .period = 3}};
const std::vector<FilterParameters> kChains[] = {kSupport, kRefractory, kBoth, kThree, kFarReaching};

class Filters : public test::DeviceTest {
 protected:
  void make(const std::vector<FilterParameters>& filters, SensorSize sensor, const GpuOptions& options = {},
            const Parameters& parameters = SaeParameters{}) {
    sensor_ = sensor;
    device_ = test::value_of(make_gpu_representation(context_, parameters, sensor, options, filters));
    reference_ = test::value_of(
        behind_filters(test::value_of(make_reference_representation(parameters, sensor)), filters));
  }

  void push(std::span<const Event> events) {
    const PushReport a = test::value_of(device_->push(events));
    const PushReport b = test::value_of(reference_->push(events));
    ASSERT_EQ(a.accepted, b.accepted);
    ASSERT_EQ(a.outside, b.outside);
  }

  void compare() {
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device_, *reference_));
    ASSERT_EQ(test::value_of(device_->filter_reports()), test::value_of(reference_->filter_reports()));
  }

  // Batches of random sizes, with empty ones among them, compared after each.
  void feed(std::span<const Event> events, std::mt19937& random) {
    size_t done = 0;
    while (done < events.size()) {
      const size_t n =
          random() % 5 == 0 ? 0 : std::min(events.size() - done, 1 + random() % (events.size() / 2));
      ASSERT_NO_FATAL_FAILURE(push(events.subspan(done, n)));
      ASSERT_NO_FATAL_FAILURE(compare());
      done += n;
    }
  }

  SensorSize sensor_;
  std::unique_ptr<GpuRepresentation> device_;
  std::unique_ptr<Representation> reference_;
};

// Behind the same filters every representation that is exact sees the same events.
TEST_F(Filters, EveryRepresentation) {
  std::mt19937 random(6);
  for (const RepresentationInfo& info : representations()) {
    SCOPED_TRACE(info.name);
    if (!info.exact) continue;
    make(kBoth, {61, 37}, {}, *parse_parameters(info.name));
    ASSERT_NO_FATAL_FAILURE(feed(make_stream(Spread::moving_edge, sensor_, 1500, random()), random));
  }
}

TEST_F(Filters, CountsOfATimeWindowAreRefused) {
  const auto refused =
      make_gpu_representation(context_, TimeWindowParameters{.counts = true}, {8, 8}, {}, kSupport);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::illegal_parameter);
}

TEST_F(Filters, EverySpread) {
  std::mt19937 random(1);
  for (const auto& chain : kChains) {
    for (Spread spread : test::kSpreads) {
      SCOPED_TRACE(static_cast<int>(spread));
      GpuOptions options;
      options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 900);
      make(chain, {150, 70}, options);  // several tiles
      const auto events =
          make_stream(spread, sensor_, 2500, random(), static_cast<int64_t>(random()) - 2'000'000'000);
      ASSERT_NO_FATAL_FAILURE(feed(events, random));
    }
  }
}

TEST_F(Filters, TinyAndOddSensors) {
  std::mt19937 random(2);
  for (const SensorSize sensor :
       {SensorSize{1, 1}, SensorSize{3, 2}, SensorSize{17, 16}, SensorSize{130, 33}}) {
    for (const auto& chain : kChains) {
      make(chain, sensor);
      ASSERT_NO_FATAL_FAILURE(feed(make_stream(Spread::beyond, sensor, 600, random()), random));
    }
  }
}

// Steps back in time, and times far apart. (Of those further apart than this, a representation behind
// reference filters may refuse what it accepts behind filters on the device: its first event is the first one
// that passed.)
TEST_F(Filters, TimesThatJump) {
  std::mt19937 random(3);
  constexpr int64_t kFar = (int64_t{1} << 47) - 1;
  for (const auto& chain : kChains) {
    make(chain, {9, 5});
    const int64_t jumps[] = {0, 1, -1, 24, 25, 26, 60, -60, kFar, -kFar};
    std::vector<Event> events = make_stream(Spread::uniform, sensor_, 1000, 3);
    events[0].t = -17;
    for (size_t i = 1; i < events.size(); ++i) events[i].t = -17 + jumps[random() % std::size(jumps)];
    ASSERT_NO_FATAL_FAILURE(feed(events, random));
  }
}

TEST_F(Filters, ResetForgetsEverything) {
  std::mt19937 random(4);
  make(kBoth, {30, 20});
  for (int64_t t_begin : {int64_t{0}, int64_t{1} << 60, -(int64_t{1} << 60)}) {
    ASSERT_NO_FATAL_FAILURE(feed(make_stream(Spread::one_row, sensor_, 800, random(), t_begin), random));
    ASSERT_TRUE(device_->reset() && reference_->reset());
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

// More events in one list than a driver's loops count: see Quirks::loop_trips.
TEST_F(Filters, HotPixel) {
  for (const auto& chain : {kSupport, kRefractory}) {
    make(chain, {64, 48});
    ASSERT_NO_FATAL_FAILURE(push(make_stream(Spread::one_pixel, sensor_, 100'000, 5)));
    ASSERT_NO_FATAL_FAILURE(compare());
  }
}

TEST_F(Filters, RefusesWhatIsNotLegal) {
  const std::vector<FilterParameters> illegal = {SupportFilter{.range = 8}};
  const auto filtered = make_gpu_representation(context_, SaeParameters{}, {8, 8}, {}, illegal);
  ASSERT_FALSE(filtered);
  EXPECT_EQ(filtered.error().code, ErrorCode::illegal_parameter);
}

}  // namespace
}  // namespace scarf
