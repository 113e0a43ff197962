#include "scarf/core/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr SensorSize kSensor = {8, 6};

Event event(int64_t t, int32_t x, int32_t y = 0, uint8_t p = 1) {
  return {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), p};
}

std::unique_ptr<EventFilter> make(const FilterParameters& parameters, SensorSize sensor = kSensor) {
  auto filter = make_reference_filter(parameters, sensor);
  EXPECT_TRUE(filter.ok()) << filter.error().message;
  return std::move(*filter);
}

std::vector<Event> passing(EventFilter& filter, const std::vector<Event>& events) {
  std::vector<Event> out;
  const auto kept = filter.filter(events, out);
  EXPECT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_EQ(*kept, out.size());
  return out;
}

std::vector<Event> passing(const FilterParameters& parameters, const std::vector<Event>& events) {
  return passing(*make(parameters), events);
}

std::string message(const std::string& words) {
  const auto parsed = parse_filter(words);
  EXPECT_FALSE(parsed.ok()) << words;
  return parsed.ok() ? "" : parsed.error().message;
}

std::vector<Event> random_events(size_t count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Event> events(count);
  int64_t t = -500;
  for (Event& e : events) {
    t += static_cast<int64_t>(random() % 100) - 10;
    // One column and one row more than the sensor has.
    e = event(t, static_cast<int32_t>(random() % (kSensor.width + 1)),
              static_cast<int32_t>(random() % (kSensor.height + 1)), static_cast<uint8_t>(random() % 2));
  }
  return events;
}

TEST(SupportFilter, FirstEventHasNoSupport) {
  EXPECT_THAT(passing(SupportFilter{}, {event(0, 3, 3)}), IsEmpty());
}

TEST(SupportFilter, OwnPixelAndNeighboursSupport) {
  const SupportFilter filter{1, 100};
  EXPECT_THAT(passing(filter, {event(0, 3, 3), event(50, 3, 3)}), ElementsAre(event(50, 3, 3)));
  for (int32_t y = 0; y < 6; ++y) {
    for (int32_t x = 0; x < 8; ++x) {
      const bool near = std::abs(x - 3) <= 1 && std::abs(y - 3) <= 1;
      EXPECT_EQ(passing(filter, {event(0, 3, 3), event(50, x, y)}).size(), near ? 1 : 0) << x << "," << y;
    }
  }
}

TEST(SupportFilter, Range) {
  const std::vector<Event> events = {event(0, 0, 0), event(1, 7, 5)};
  EXPECT_THAT(passing(SupportFilter{6, 100}, events), IsEmpty());
  EXPECT_THAT(passing(SupportFilter{7, 100}, events), ElementsAre(events[1]));
}

TEST(SupportFilter, PeriodIsInclusive) {
  const SupportFilter filter{1, 100};
  EXPECT_THAT(passing(filter, {event(7, 3), event(107, 4)}), ElementsAre(event(107, 4)));
  EXPECT_THAT(passing(filter, {event(7, 3), event(108, 4)}), IsEmpty());
}

TEST(SupportFilter, OtherPolarityDoesNotSupport) {
  EXPECT_THAT(passing(SupportFilter{}, {event(0, 3, 3, 0), event(1, 3, 3, 1)}), IsEmpty());
}

TEST(SupportFilter, RejectedEventsSupport) {
  // The second event supports the third, although it was rejected itself.
  EXPECT_THAT(passing(SupportFilter{1, 10}, {event(0, 3), event(100, 3), event(105, 4)}),
              ElementsAre(event(105, 4)));
}

TEST(SupportFilter, BackwardTimes) {
  // The last event at x = 3 is later than the new one: support. It is the last to arrive that counts: at
  // t = 100 the event at 95 has been replaced by one at 0.
  EXPECT_THAT(passing(SupportFilter{1, 10}, {event(1000, 3), event(500, 4)}), ElementsAre(event(500, 4)));
  EXPECT_THAT(passing(SupportFilter{1, 10}, {event(95, 3), event(0, 3), event(100, 4)}),
              ElementsAre(event(0, 3)));
}

TEST(RefractoryFilter, BlindForThePeriod) {
  // 0 passes; 9 does not, and does not prolong the blindness; 10 passes.
  EXPECT_THAT(passing(RefractoryFilter{10}, {event(0, 3), event(9, 3), event(10, 3), event(10, 3)}),
              ElementsAre(event(0, 3), event(10, 3)));
}

TEST(RefractoryFilter, PixelsOnTheirOwnPolaritiesTogether) {
  EXPECT_THAT(passing(RefractoryFilter{10}, {event(0, 3, 0, 1), event(1, 3, 0, 0), event(1, 4, 0, 0)}),
              ElementsAre(event(0, 3, 0, 1), event(1, 4, 0, 0)));
}

TEST(RefractoryFilter, BackwardStepPasses) {
  // 99 passes because it is before 100; then 105 is within 10 of 99, and 109 is not.
  EXPECT_THAT(passing(RefractoryFilter{10}, {event(100, 3), event(99, 3), event(105, 3), event(109, 3)}),
              ElementsAre(event(100, 3), event(99, 3), event(109, 3)));
}

TEST(Filters, EventsOutsidePassAndLeaveNoTrace) {
  const std::vector<Event> events = {event(0, 8, 0), event(1, 7, 0), event(2, 0, 6)};
  const auto support = make(SupportFilter{});
  EXPECT_THAT(passing(*support, events), ElementsAre(events[0], events[2]));
  EXPECT_EQ(support->report(), (FilterReport{0, 1, 2}));
  const auto refractory = make(RefractoryFilter{});
  EXPECT_THAT(passing(*refractory, {events[0], events[0], events[1]}),
              ElementsAre(events[0], events[0], events[1]));
  EXPECT_EQ(refractory->report(), (FilterReport{1, 0, 2}));
}

TEST(Filters, AppendAndCount) {
  const auto filter = make(RefractoryFilter{10});
  std::vector<Event> out = {event(-1, 0)};
  EXPECT_EQ(*filter->filter(std::vector<Event>{event(0, 3), event(1, 3)}, out), 1);
  EXPECT_EQ(*filter->filter({}, out), 0);
  EXPECT_EQ(*filter->filter(std::vector<Event>{event(5, 3), event(20, 3)}, out), 1);
  EXPECT_THAT(out, ElementsAre(event(-1, 0), event(0, 3), event(20, 3)));
  EXPECT_EQ(filter->report(), (FilterReport{2, 2, 0}));
  EXPECT_EQ(filter->sensor(), kSensor);
}

TEST(Filters, ResetForgets) {
  for (const FilterParameters& parameters :
       {FilterParameters(SupportFilter{}), FilterParameters(RefractoryFilter{})}) {
    const auto filter = make(parameters);
    const std::vector<Event> events = {event(0, 3), event(1, 3), event(5000, 3)};
    const auto once = passing(*filter, events);
    ASSERT_TRUE(filter->reset().ok());
    EXPECT_EQ(filter->report(), FilterReport{});
    EXPECT_EQ(passing(*filter, events), once);
    // Also the time of the first event: without reset this one would be too far away.
    ASSERT_TRUE(filter->reset().ok());
    passing(*filter, {event(int64_t{1} << 50, 3)});
  }
}

TEST(Filters, RefusedBatchChangesNothing) {
  for (const FilterParameters& parameters :
       {FilterParameters(SupportFilter{}), FilterParameters(RefractoryFilter{})}) {
    const auto filter = make(parameters);
    passing(*filter, {event(0, 3)});
    const FilterReport before = filter->report();
    std::vector<Event> out;
    for (const Event& bad : {event(2, 3, 0, 2), event(int64_t{1} << 48, 3)}) {
      const auto refused = filter->filter(std::vector<Event>{event(5, 1), event(6, 1), bad}, out);
      ASSERT_FALSE(refused.ok());
      EXPECT_EQ(refused.error().code, ErrorCode::refused_batch);
      EXPECT_THAT(refused.error().message, HasSubstr("event 2 of the batch"));
    }
    EXPECT_THAT(out, IsEmpty());
    EXPECT_EQ(filter->report(), before);
    // Had the pixel at x = 1 been remembered, support would let this pass and refractory would not.
    const bool refractory = std::holds_alternative<RefractoryFilter>(parameters);
    EXPECT_EQ(passing(*filter, {event(10, 1)}).size(), refractory ? 1 : 0);
  }
}

TEST(Filters, ExtremeTimes) {
  const auto filter = make(RefractoryFilter{10});
  EXPECT_EQ(passing(*filter, {event(INT64_MAX, 3), event(INT64_MAX, 3), event(INT64_MAX - 5, 3)}).size(), 2);
  const auto support = make(SupportFilter{1, 10});
  EXPECT_EQ(
      passing(*support, {event(INT64_MIN, 3), event(INT64_MIN + 10, 3), event(INT64_MIN + 21, 3)}).size(), 1);
}

TEST(Filters, BatchesDoNotMatter) {
  const auto events = random_events(3000, 7);
  for (const FilterParameters& parameters :
       {FilterParameters(SupportFilter{1, 200}), FilterParameters(SupportFilter{2, 50}),
        FilterParameters(RefractoryFilter{2000})}) {
    const auto whole = make(parameters);
    const auto expected = passing(*whole, events);
    EXPECT_GT(whole->report().passed, 100);
    EXPECT_GT(whole->report().rejected, 100);
    EXPECT_EQ(whole->report().passed + whole->report().rejected + whole->report().outside, events.size());
    EXPECT_EQ(whole->report().passed + whole->report().outside, expected.size());
    std::mt19937_64 random(3);
    const auto split = make(parameters);
    std::vector<Event> out;
    for (size_t i = 0; i < events.size();) {
      const size_t count = std::min<size_t>(random() % 40, events.size() - i);
      ASSERT_TRUE(split->filter(std::span(events).subspan(i, count), out).ok());
      i += count;
    }
    EXPECT_EQ(out, expected);
    EXPECT_EQ(split->report(), whole->report());
  }
}

TEST(FilterChain, FiltersBehindEachOther) {
  const auto events = random_events(2000, 9);
  const auto first = passing(RefractoryFilter{500}, events);
  const auto second = passing(SupportFilter{1, 300}, first);
  const auto third = passing(RefractoryFilter{900}, second);
  ASSERT_LT(second.size(), first.size());
  ASSERT_LT(third.size(), second.size());

  std::vector<std::unique_ptr<EventFilter>> filters;
  filters.push_back(make(RefractoryFilter{500}));
  filters.push_back(make(SupportFilter{1, 300}));
  filters.push_back(make(RefractoryFilter{900}));
  FilterChain chain(std::move(filters));
  EXPECT_FALSE(chain.empty());
  std::vector<Event> out;
  for (size_t i = 0; i < events.size(); i += 500) {
    const auto kept = chain.filter(std::span(events).subspan(i, 500));
    ASSERT_TRUE(kept.ok());
    out.insert(out.end(), kept->begin(), kept->end());
  }
  EXPECT_EQ(out, third);
  const auto reports = chain.reports();
  ASSERT_EQ(reports.size(), 3);
  EXPECT_EQ(reports[1].passed + reports[1].outside, second.size());
  EXPECT_EQ(reports[1].passed + reports[1].rejected + reports[1].outside, first.size());

  ASSERT_TRUE(chain.reset().ok());
  EXPECT_EQ(chain.reports(), std::vector<FilterReport>(3));
  const auto again = chain.filter(events);
  ASSERT_TRUE(again.ok());
  EXPECT_TRUE(std::ranges::equal(*again, third));
}

TEST(FilterChain, EmptyChainHandsOnTheVeryEvents) {
  FilterChain chain;
  EXPECT_TRUE(chain.empty());
  const auto events = random_events(10, 1);
  const auto kept = chain.filter(events);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->data(), events.data());
  EXPECT_EQ(kept->size(), events.size());
}

TEST(ParseFilter, Words) {
  const auto plain = parse_filter("support");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(std::get<SupportFilter>(*plain).range, 1);
  EXPECT_EQ(std::get<SupportFilter>(*plain).period, 100'000);
  const auto support = parse_filter("support:range=3,period=2s");
  ASSERT_TRUE(support.ok());
  EXPECT_EQ(std::get<SupportFilter>(*support).range, 3);
  EXPECT_EQ(std::get<SupportFilter>(*support).period, 2'000'000);
  const auto period = [](const std::string& words) {
    const auto filter = parse_filter(words);
    EXPECT_TRUE(filter.ok()) << words;
    return std::get<RefractoryFilter>(*filter).period;
  };
  EXPECT_EQ(period("refractory"), 1'000);
  EXPECT_EQ(period("refractory:period=1"), 1);
  EXPECT_EQ(period("refractory:period=250us"), 250);
  EXPECT_EQ(period("refractory:period=7ms"), 7'000);
  EXPECT_EQ(period("refractory:period=1.5ms"), 1'500);
  EXPECT_EQ(period("refractory:period=1000s"), 1'000'000'000);
}

TEST(ParseFilter, ErrorsNameWhatIsLegal) {
  EXPECT_EQ(message("noise"), "filter 'noise' is unknown; use one of support, refractory");
  EXPECT_EQ(message(""), "filter '' is unknown; use one of support, refractory");
  EXPECT_EQ(message("support:range=8"), "support: range is 8, legal is 1 to 7");
  EXPECT_EQ(message("support:range=0"), "support: range is 0, legal is 1 to 7");
  EXPECT_EQ(message("support:range=1ms"), "support: range is '1ms', legal is 1 to 7");
  EXPECT_EQ(message("support:radius=1"), "support: parameter 'radius' is unknown; use one of range, period");
  EXPECT_EQ(message("refractory:range=1"), "refractory: parameter 'range' is unknown; use one of period");
  EXPECT_EQ(message("support:range=1,range=1"),
            "filter 'support:range=1,range=1': range is given twice; give it once");
  EXPECT_EQ(message("refractory:period=0"), "refractory: period is 0s, legal is 1us to 1000s");
  EXPECT_EQ(message("refractory:period=1001s"), "refractory: period is 1001s, legal is 1us to 1000s");
  for (const std::string word : {"-1", "1.5us", "ms", "", "1 ms", "1m", "1ms5", "9223372036854775807s", "+5",
                                 "99999999999999999999"}) {
    EXPECT_EQ(message("refractory:period=" + word),
              "refractory: period is '" + word + "', legal is 1us to 1000s");
  }
  for (const std::string words :
       {"support:", "support:range", "support:=1", "support:range=1,", "support:,range=1"}) {
    EXPECT_THAT(message(words), HasSubstr("is no parameter; write filters as name:parameter=value")) << words;
  }
}

TEST(MakeFilter, IllegalParametersAndSensors) {
  const auto error = [](const FilterParameters& parameters, SensorSize sensor = kSensor) {
    const auto filter = make_reference_filter(parameters, sensor);
    EXPECT_FALSE(filter.ok());
    EXPECT_EQ(filter.error().code, ErrorCode::illegal_parameter);
    return filter.error().message;
  };
  EXPECT_EQ(error(SupportFilter{8, 1}), "support: range is 8, legal is 1 to 7");
  EXPECT_THAT(error(SupportFilter{1, 0}), HasSubstr("period is 0s, legal is 1us to 1000s"));
  EXPECT_THAT(error(RefractoryFilter{1'000'000'001}), HasSubstr("period is 1000000001us"));
  EXPECT_EQ(error(SupportFilter{}, {0, 5}), "sensor is 0x5, legal is 1 to 16384 pixels per axis");
  EXPECT_THAT(error(SupportFilter{}, {5, kMaxSensorSize + 1}), HasSubstr("sensor is 5x16385"));
}

TEST(FilterInfos, DefaultsParse) {
  for (const FilterInfo& info : filters()) {
    std::string words = info.name;
    for (size_t i = 0; i < info.parameters.size(); ++i) {
      const ParameterInfo& parameter = info.parameters[i];
      EXPECT_FALSE(parameter.description.empty());
      words += (i == 0 ? ":" : ",") + parameter.name + "=" + parameter.value;
    }
    const auto parsed = parse_filter(words);
    ASSERT_TRUE(parsed.ok()) << parsed.error().message;
    EXPECT_EQ(info_of(*parsed).name, info.name);
    EXPECT_TRUE(checked_filter(*parsed).ok());
  }
  EXPECT_EQ(filters()[0].parameters[1].value, "100ms");
}

}  // namespace
}  // namespace scarf
