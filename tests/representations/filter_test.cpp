// Noise filters on the device against the reference filters in front of the reference representations.
#include "gpu/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "gpu/stream.h"
#include "representations/make.h"
#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;

const std::vector<FilterParameters> kSupport = {SupportFilter{.range = 1, .period = 40}};
const std::vector<FilterParameters> kRefractory = {RefractoryFilter{.period = 60}};
const std::vector<FilterParameters> kBoth = {SupportFilter{.range = 2, .period = 30}, RefractoryFilter{.period = 25}};
const std::vector<FilterParameters> kThree = {RefractoryFilter{.period = 9}, SupportFilter{.range = 3, .period = 20},
                                              SupportFilter{.range = 1, .period = 300}};
const std::vector<FilterParameters> kFarReaching = {SupportFilter{.range = 7, .period = 3}};
const std::vector<FilterParameters> kChains[] = {kSupport, kRefractory, kBoth, kThree, kFarReaching};

FilterChain reference_chain(const std::vector<FilterParameters>& filters, SensorSize sensor) {
  std::vector<std::unique_ptr<EventFilter>> made;
  for (const FilterParameters& filter : filters) {
    made.push_back(test::value_of(make_reference_filter(filter, sensor)));
  }
  return FilterChain(std::move(made));
}

class Filters : public test::DeviceTest {
 protected:
  // A time surface shows where which event passed, and when.
  void make(const std::vector<FilterParameters>& filters, SensorSize sensor, const GpuOptions& options = {}) {
    sensor_ = sensor;
    vulkan::Device& device = context_->vulkan();
    auto inner = test::value_of(make_sae(device, SaeParameters{}, sensor, options));
    ImagePipeline* images = inner.get();
    auto filtered = FilteredPipeline::create(device, std::move(inner), images, /*asks_for_newest=*/true, filters);
    ASSERT_TRUE(filtered) << filtered.error().message;
    pipeline_ = filtered->get();
    stream_ = test::value_of(Stream::create(context_, std::move(*filtered), options));
    chain_ = reference_chain(filters, sensor);
    reference_ = test::value_of(make_reference_representation(SaeParameters{}, sensor));
    outside_ = 0;
  }

  void push(std::span<const Event> events) {
    const auto report = stream_->push(events);
    ASSERT_TRUE(report) << report.error().message;
    outside_ += report->outside;
    const auto passing = chain_.filter(events);
    ASSERT_TRUE(passing) << passing.error().message;
    ASSERT_TRUE(reference_->push(*passing));
  }

  void compare() {
    ASSERT_EQ(state(), test::value_of(reference_->state()));
    const auto image = test::value_of(stream_->query<Image<uint8_t>>(
        QueryKind::image, [&](Query& q, const StreamTimes& t) { return pipeline_->record_u8(q.commands, t, {}); }));
    ASSERT_EQ(image, test::value_of(reference_->u8_image()));
    auto reports = test::value_of(stream_->query<std::vector<uint8_t>>(
        QueryKind::state, [&](Query&, const StreamTimes&) -> Result<Answer<std::vector<uint8_t>>> {
          auto answer = pipeline_->record_reports();
          return Answer<std::vector<uint8_t>>{answer.parts, [&, read = answer.read](HostParts parts) {
                                                reports_ = test::value_of(read(parts));
                                                return Result<std::vector<uint8_t>>(std::vector<uint8_t>{});
                                              }};
        }));
    for (FilterReport& report : reports_) report.outside = outside_;
    ASSERT_EQ(reports_, chain_.reports());
  }

  std::vector<uint8_t> state() {
    return test::value_of(stream_->query<std::vector<uint8_t>>(
        QueryKind::state, [&](Query& q, const StreamTimes& t) { return pipeline_->record_state(q.commands, t); }));
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
  FilteredPipeline* pipeline_ = nullptr;  // of the stream
  std::shared_ptr<Stream> stream_;
  FilterChain chain_;
  std::unique_ptr<Representation> reference_;
  std::vector<FilterReport> reports_;
  uint64_t outside_ = 0;
};

TEST_F(Filters, EverySpread) {
  std::mt19937 random(1);
  for (const auto& chain : kChains) {
    for (Spread spread : test::kSpreads) {
      SCOPED_TRACE(static_cast<int>(spread));
      GpuOptions options;
      options.submission_events = random() % 2 == 0 ? 0 : 1 + static_cast<uint32_t>(random() % 900);
      make(chain, {61, 37}, options);
      const auto events = make_stream(spread, sensor_, 1500, random(), static_cast<int64_t>(random()) - 2'000'000'000);
      ASSERT_NO_FATAL_FAILURE(feed(events, random));
    }
  }
}

TEST_F(Filters, TinyAndOddSensors) {
  std::mt19937 random(2);
  for (const SensorSize sensor : {SensorSize{1, 1}, SensorSize{3, 2}, SensorSize{17, 16}, SensorSize{130, 33}}) {
    for (const auto& chain : kChains) {
      make(chain, sensor);
      ASSERT_NO_FATAL_FAILURE(feed(make_stream(Spread::beyond, sensor, 600, random()), random));
    }
  }
}

// Steps back in time, and times far apart. (Of those further apart than this, a representation behind reference filters
// may refuse what it accepts behind filters on the device: its first event is the first one that passed.)
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
    ASSERT_TRUE(stream_->reset() && chain_.reset() && reference_->reset());
    outside_ = 0;
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
  auto inner = test::value_of(make_sae(context_->vulkan(), SaeParameters{}, {8, 8}, {}));
  const std::vector<FilterParameters> illegal = {SupportFilter{.range = 8}};
  const auto filtered = FilteredPipeline::create(context_->vulkan(), std::move(inner), nullptr, false, illegal);
  ASSERT_FALSE(filtered);
  EXPECT_EQ(filtered.error().code, ErrorCode::illegal_parameter);
}

}  // namespace
}  // namespace scarf
