// What holds for every representation in every variant.
#include "tests/support/representations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "tests/support/streams.h"

namespace scarf::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr SensorSize kSensor = {27, 22};

// Times in steps of some 50 us, so that all windows have an old end, with one long step back.
std::vector<Event> stream(Spread spread, size_t count = 1'500, uint64_t seed = 1) {
  auto events = make_stream(spread, kSensor, count, seed);
  for (size_t i = 0; i < count; ++i)
    events[i].t = 1'000'000 + 53 * events[i].t - (i > count / 2 ? 30'000 : 0);
  return events;
}

// Cuts of random length, many of them empty or of one event.
void push_in_pieces(Representation& r, std::span<const Event> events, uint64_t seed) {
  std::mt19937 random(static_cast<uint32_t>(seed));
  while (!events.empty()) {
    const size_t most = random() % 3 == 0 ? 200 : 2;
    const size_t length = std::min<size_t>(events.size(), random() % (most + 1));
    const auto report = value_of(r.push(events.first(length)));
    ASSERT_EQ(report.accepted, length);
    events = events.subspan(length);
  }
  EXPECT_TRUE(r.push({}).ok());
}

// What the pictures say about the time of the newest event.
bool time_dependent(const Parameters& parameters) {
  return std::holds_alternative<TimeWindowParameters>(parameters) ||
         std::holds_alternative<SaeParameters>(parameters);
}

class EveryRepresentation : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Representation> make(const std::vector<Event>& events = {}) const {
    return reference(GetParam().parameters, kSensor, events);
  }
};

TEST_P(EveryRepresentation, SensorAndSizes) {
  const auto r = make();
  EXPECT_EQ(r->sensor(), kSensor);
  const auto u8 = value_of(r->u8_image());
  EXPECT_EQ(u8.width, 27);
  EXPECT_EQ(u8.height, 22);
  EXPECT_EQ(u8.planes, 1);
  EXPECT_EQ(u8.pixels.size(), 27U * 22);
  const auto f32 = value_of(r->float_image());
  EXPECT_EQ(f32.width, 27);
  EXPECT_EQ(f32.planes, 1);
  const auto raw = value_of(r->raw_image());
  EXPECT_EQ(raw.height, 22);
  EXPECT_EQ(raw.planes, std::holds_alternative<SaeParameters>(GetParam().parameters) ? 2 : 1);
}

TEST_P(EveryRepresentation, BlackBeforeAnyEvent) {
  const auto* chain = std::get_if<ChainSaeParameters>(&GetParam().parameters);
  if (chain != nullptr && chain->rule == ChainSaeParameters::Rule::event_driven)
    return;  // ranks from the start
  const auto r = make();
  EXPECT_THAT(u8_of(*r), Each(0));
  EXPECT_THAT(float_of(*r), Each(0));
  EXPECT_THAT(u8_of(*r, 1'000'000), Each(0));
}

TEST_P(EveryRepresentation, TheFirstEventShows) {
  if (std::holds_alternative<AaeParameters>(GetParam().parameters)) return;  // draws from the second on
  const auto r = make({event(5, 13, 11)});
  const auto levels = value_of(r->float_image());
  EXPECT_GT(levels.at(13, 11), 0);
  EXPECT_EQ(levels.at(13, 11), *std::max_element(levels.pixels.begin(), levels.pixels.end()));
}

TEST_P(EveryRepresentation, BatchesDoNotMatter) {
  for (Spread spread : kSpreads) {
    SCOPED_TRACE(testing::Message() << "spread " << static_cast<int>(spread));
    const auto events = stream(spread);
    const auto whole = make(events);
    const auto pieces = make();
    ASSERT_NO_FATAL_FAILURE(push_in_pieces(*pieces, events, 5 + static_cast<uint64_t>(spread)));
    ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*pieces, *whole));
  }
}

TEST_P(EveryRepresentation, BatchesDoNotMatterBetweenQueries) {
  const auto a = make();
  const auto b = make();
  const auto events = stream(Spread::moving_edge, 1'200, 4);
  for (size_t i = 0; i < events.size(); i += 300) {
    const auto part = std::span(events).subspan(i, 300);
    ASSERT_NO_FATAL_FAILURE(push_in_pieces(*a, part, i));
    ASSERT_TRUE(b->push(part));
    ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*a, *b));
  }
}

TEST_P(EveryRepresentation, QueriesDoNotMatter) {
  const auto asked = make();
  const auto left_alone = make();
  const auto events = stream(Spread::uniform, 900, 9);
  for (size_t i = 0; i < events.size(); i += 300) {
    const auto part = std::span(events).subspan(i, 300);
    ASSERT_TRUE(asked->push(part));
    ASSERT_TRUE(left_alone->push(part));
    (void)asked->state().wait();
    (void)asked->events().wait();
    if (query_changes_state(GetParam().parameters)) continue;
    (void)u8_of(*asked, 7);
    (void)float_of(*asked, INT64_MAX);
    (void)raw_of(*asked);
  }
  expect_same_outputs(*asked, *left_alone);
}

TEST_P(EveryRepresentation, EqualQueriesGiveEqualPictures) {
  if (query_changes_state(GetParam().parameters)) return;
  const auto r = make(stream(Spread::moving_edge));
  expect_same_outputs(*r, *r);
}

TEST_P(EveryRepresentation, EventsOutsideAreCountedAndDropped) {
  const auto inside = stream(Spread::uniform, 500, 12);
  std::mt19937 random(3);
  std::vector<Event> mixed;
  uint64_t outside = 0;
  const auto add_outside = [&] {
    // Any time and polarity, on each side of the sensor.
    Event e = event(static_cast<int64_t>((uint64_t{random()} << 32) | random()), 27, 0, 9);
    if (random() % 2 == 0) e = event(e.t, 26, 22);
    if (random() % 3 == 0) e = event(e.t, 65'535, 65'535, 1);
    mixed.push_back(e);
    ++outside;
  };
  add_outside();
  for (const Event& e : inside) {
    if (random() % 3 == 0) add_outside();
    mixed.push_back(e);
  }
  add_outside();
  const auto a = make();
  const auto report = value_of(a->push(mixed));
  EXPECT_EQ(report.accepted, mixed.size());
  EXPECT_EQ(report.outside, outside);
  const auto b = make(inside);
  expect_same_outputs(*a, *b);
}

TEST_P(EveryRepresentation, ARefusedBatchChangesNothing) {
  const auto events = stream(Spread::uniform, 300, 15);
  const auto a = make(events);
  const auto b = make(events);
  auto bad = stream(Spread::moving_edge, 50, 16);
  bad[49] = event(0, 0, 0, 2);
  const auto polarity = a->push(bad);
  ASSERT_FALSE(polarity.ok());
  EXPECT_EQ(polarity.error().code, ErrorCode::refused_batch);
  EXPECT_THAT(polarity.error().message, HasSubstr("event 49"));
  bad[49] = event(events[0].t + (int64_t{1} << 48), 0);
  const auto time = a->push(bad);
  ASSERT_FALSE(time.ok());
  EXPECT_EQ(time.error().code, ErrorCode::refused_batch);
  ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*a, *b));
  // Work goes on, from the same first time.
  const auto more = stream(Spread::corners, 100, 17);
  ASSERT_TRUE(a->push(more));
  ASSERT_TRUE(b->push(more));
  expect_same_outputs(*a, *b);
}

TEST_P(EveryRepresentation, ARefusedFirstBatchLeavesNoFirstTime) {
  const auto r = make();
  const std::vector<Event> bad = {event(0, 0), event(0, 1, 0, 2)};
  ASSERT_FALSE(r->push(bad).ok());
  const int64_t far = int64_t{1} << 50;
  const std::vector<Event> events = {event(far, 3, 3), event(far + 1, 4, 4)};
  ASSERT_TRUE(r->push(events).ok());
  expect_same_outputs(*r, *make(events));
}

TEST_P(EveryRepresentation, ResetIsNew) {
  const auto a = make(stream(Spread::moving_edge, 800, 21));
  (void)a->u8_image().wait();
  ASSERT_TRUE(a->reset());
  const auto b = make();
  ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*a, *b));
  // The first time is forgotten as well.
  auto events = stream(Spread::uniform, 400, 22);
  for (Event& e : events) e.t -= int64_t{1} << 52;
  ASSERT_TRUE(a->push(events).ok());
  ASSERT_TRUE(b->push(events).ok());
  expect_same_outputs(*a, *b);
}

TEST_P(EveryRepresentation, PolaritiesShareOneSurface) {
  auto events = stream(Spread::moving_edge, 900, 25);
  const auto r = make(events);
  for (Event& e : events) e.p = 1 - e.p;
  const auto flipped = make(events);
  EXPECT_EQ(u8_of(*r), u8_of(*flipped));
  EXPECT_EQ(float_of(*r), float_of(*flipped));
}

TEST_P(EveryRepresentation, OnlyDifferencesOfTimesCount) {
  auto events = stream(Spread::moving_edge, 900, 31);
  const auto r = make(events);
  for (Event& e : events) e.t -= 123'456'789'012'345;
  const auto shifted = make(events);
  EXPECT_EQ(u8_of(*r), u8_of(*shifted));
  EXPECT_EQ(float_of(*r), float_of(*shifted));
}

TEST_P(EveryRepresentation, WithoutATimeThePictureIsForTheNewestEvent) {
  const auto events = stream(Spread::uniform, 900, 35);
  const auto a = make(events);
  const auto b = make(events);
  ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*a, *b, events.back().t));
  EXPECT_EQ(u8_of(*make(events), events.back().t), u8_of(*make(events)));
  if (time_dependent(GetParam().parameters)) {
    EXPECT_THAT(u8_of(*a, int64_t{1} << 60), Each(0));
  } else {
    EXPECT_EQ(u8_of(*make(events), int64_t{1} << 60), u8_of(*make(events)));
    EXPECT_EQ(float_of(*make(events), INT64_MIN), float_of(*make(events)));
  }
}

TEST_P(EveryRepresentation, BytesAndFloatsAgree) {
  const auto* sits = std::get_if<SitsParameters>(&GetParam().parameters);
  const double scale = sits != nullptr && sits->rule == SitsParameters::Rule::event_driven
                           ? std::pow(sits->kernel | 1, 2)  // the raw value
                           : 255;
  // Sums of brightness are not clipped: those of scarf, of time_window with counts, and of aae.
  const bool sums = info_of(GetParam().parameters).has_events;
  for (Spread spread : {Spread::moving_edge, Spread::one_row}) {
    const auto events = stream(spread);
    const auto bytes = u8_of(*make(events));
    const auto levels = float_of(*make(events));
    for (size_t i = 0; i < bytes.size(); ++i) {
      ASSERT_NEAR(bytes[i], std::min(255.0, scale * levels[i]), 0.501) << "pixel " << i;
      ASSERT_GE(levels[i], 0);
      if (!sums) {
        ASSERT_LE(levels[i], 1);
      }
    }
  }
}

TEST_P(EveryRepresentation, SparseEventsAreEventsOfTheStream) {
  const auto events = stream(Spread::moving_edge);
  const auto r = make(events);
  const auto sparse = r->events().wait();
  const RepresentationInfo& info = info_of(GetParam().parameters);
  const auto* window = std::get_if<TimeWindowParameters>(&GetParam().parameters);
  const bool keeps = info.has_events && (window == nullptr || window->counts);
  ASSERT_EQ(sparse.ok(), keeps);
  if (!keeps) {
    EXPECT_EQ(sparse.error().code, ErrorCode::illegal_parameter);
    EXPECT_THAT(sparse.error().message,
                AllOf(HasSubstr("scarf"), HasSubstr("aae"), HasSubstr("time_window")));
    return;
  }
  EXPECT_FALSE(sparse->empty());
  const auto key = [](const Event& e) { return std::tuple(e.t, e.x, e.y, e.p); };
  std::multiset<std::tuple<int64_t, uint16_t, uint16_t, uint8_t>> pushed;
  for (const Event& e : events) pushed.insert(key(e));
  for (const Event& e : *sparse) {
    const auto found = pushed.find(key(e));
    ASSERT_NE(found, pushed.end());
    pushed.erase(found);
  }
}

TEST_P(EveryRepresentation, SmallAndNarrowSensors) {
  const auto* scarf = std::get_if<ScarfParameters>(&GetParam().parameters);
  if (scarf != nullptr && scarf->preset != Preset::paper && scarf->preset != Preset::light) return;
  for (const SensorSize sensor : {SensorSize{1, 1}, {2, 1}, {1, 9}, {40, 1}, {3, 2}}) {
    SCOPED_TRACE(testing::Message() << sensor.width << "x" << sensor.height);
    auto events = make_stream(Spread::uniform, sensor, 300, 41);
    for (Event& e : events) e.t *= 101;
    const auto a = reference(GetParam().parameters, sensor, events);
    const auto b = reference(GetParam().parameters, sensor);
    ASSERT_NO_FATAL_FAILURE(push_in_pieces(*b, events, 43));
    ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*a, *b));
    EXPECT_THAT(float_of(*a), Each(testing::Ge(0)));
  }
}

TEST_P(EveryRepresentation, ImpossibleSensorsAreRefused) {
  for (const SensorSize sensor : {SensorSize{0, 5}, {5, 0}, {-3, 5}, {16'385, 5}, {5, 16'385}}) {
    const auto made = make_reference_representation(GetParam().parameters, sensor);
    ASSERT_FALSE(made.ok()) << sensor.width << "x" << sensor.height;
    EXPECT_EQ(made.error().code, ErrorCode::illegal_parameter);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryRepresentation, testing::ValuesIn(representation_cases()),
                         [](const auto& tested) { return tested.param.label; });

TEST(Representations, TheCasesAreLegalAndNamedOnce) {
  std::set<std::string> labels;
  std::set<size_t> kinds;
  for (const Case& c : representation_cases()) {
    EXPECT_TRUE(labels.insert(c.label).second) << c.label;
    EXPECT_EQ(c.label.rfind(info_of(c.parameters).name, 0), 0U) << c.label;
    const auto checked = checked_parameters(c.parameters);
    EXPECT_TRUE(checked.ok()) << (checked ? "" : checked.error().message);
    kinds.insert(c.parameters.index());
  }
  EXPECT_EQ(kinds.size(), representations().size());
}

// Different parameters in one process, pushed in turns: nobody takes over the parameters of another.
TEST(Representations, InstancesAreIndependent) {
  const auto events = stream(Spread::moving_edge, 600, 51);
  std::vector<std::unique_ptr<Representation>> together;
  for (const Case& c : representation_cases()) together.push_back(reference(c.parameters, kSensor));
  for (size_t i = 0; i < events.size(); i += 200) {
    for (const auto& r : together) ASSERT_TRUE(r->push(std::span(events).subspan(i, 200)));
  }
  size_t i = 0;
  for (const Case& c : representation_cases()) {
    SCOPED_TRACE(c.label);
    ASSERT_NO_FATAL_FAILURE(expect_same_outputs(*together[i++], *reference(c.parameters, kSensor, events)));
  }
}

TEST(Representations, IllegalParametersAreRefused) {
  const Parameters illegal[] = {TimeWindowParameters{.window = 0}, SaeParameters{.tau = 0},
                                ErosParameters{.decay = 1},        TosParameters{.decay = 0},
                                SitsParameters{.kernel = 65},      AedSaeParameters{.window = 999},
                                AaeParameters{.block = 0},         ScarfParameters{Preset::paper, {}, 0}};
  for (const Parameters& parameters : illegal) {
    const auto made = make_reference_representation(parameters, kSensor);
    ASSERT_FALSE(made.ok()) << info_of(parameters).name;
    EXPECT_EQ(made.error().code, ErrorCode::illegal_parameter);
  }
}

TEST(Representations, ScarfIsTheScarfOfItsGeometry) {
  const auto events = stream(Spread::moving_edge);
  const auto made = reference(ScarfParameters{Preset::paper, {7, 0.9, 1.5}, 0.2}, kSensor, events);
  const auto geometry = make_geometry(Preset::paper, kSensor, {7, 0.9, 1.5});
  ASSERT_TRUE(geometry.ok());
  const auto scarf = value_of(make_reference_scarf(*geometry, 0.2));
  ASSERT_TRUE(scarf->push(events));
  EXPECT_EQ(u8_of(*made), value_of(scarf->u8_planes(PolarityMode::merged)).pixels);
  EXPECT_EQ(value_of(made->events()), value_of(scarf->active_events()));
  const auto counts = value_of(scarf->count_image()).pixels;
  EXPECT_EQ(raw_of(*made), std::vector<int64_t>(counts.begin(), counts.end()));
}

}  // namespace
}  // namespace scarf::test
