#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "scarf/digest/digest.h"
#include "scarf/reference/reference.h"

namespace scarf {

void PrintTo(const Geometry& geometry, std::ostream* out) {
  *out << to_string(geometry);
}

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// One row of pixels. GridAxis fields in order: size, cell, origin, grid, margin_lo, margin_hi.
constexpr GridAxis kOneRow = {1, 1, 0, 1, 0, 0};
constexpr Geometry kOnePatch = {{4, 4, 0, 1, 0, 0}, kOneRow, 2};
// Patch 0 is active on 0..2 with the field 0..3, patch 1 is active on 3..5 with the field 2..5.
constexpr Geometry kTwoPatches = {{6, 3, 0, 2, 1, 1}, kOneRow, 2};

Event event(int64_t t, int32_t x, int32_t y = 0, uint8_t p = 1) {
  return {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), p};
}

std::unique_ptr<Scarf> make(const Geometry& geometry, double accumulation = kDefaultAccumulation) {
  auto scarf = make_reference_scarf(geometry, accumulation);
  EXPECT_TRUE(scarf.ok()) << scarf.error().message;
  return std::move(*scarf);
}

std::unique_ptr<Scarf> make(const Geometry& geometry, const std::vector<Event>& events) {
  auto scarf = make(geometry);
  EXPECT_TRUE(scarf->push(events).ok());
  return scarf;
}

// The value of a query that must not fail.
template <class T>
T get(Pending<T> pending) {
  auto result = pending.wait();
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(*result);
}

std::string digest(Scarf& scarf) {
  return state_digest(get(scarf.snapshot()));
}

Geometry preset(Preset p, SensorSize sensor, int32_t cell, double alpha = 2.0) {
  const auto geometry = make_geometry(p, sensor, {cell, std::nullopt, alpha});
  EXPECT_TRUE(geometry.ok());
  return *geometry;
}

std::vector<Event> random_events(SensorSize sensor, size_t count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Event> events(count);
  int64_t t = 1'000'000;
  for (Event& e : events) {
    t += static_cast<int64_t>(random() % 100) - 10;  // small back-steps are legal
    e = event(t, static_cast<int32_t>(random() % sensor.width),
              static_cast<int32_t>(random() % sensor.height), static_cast<uint8_t>(random() % 2));
  }
  return events;
}

TEST(ReferenceScarf, EmptyState) {
  const auto scarf = make(kTwoPatches);
  EXPECT_EQ(scarf->geometry(), kTwoPatches);
  EXPECT_EQ(get(scarf->count_image()), Image<int32_t>(6, 1));
  EXPECT_THAT(get(scarf->active_events()), IsEmpty());
  EXPECT_THAT(get(scarf->patch_events(1, false)), IsEmpty());
  const auto snapshot = get(scarf->snapshot());
  EXPECT_THAT(snapshot.totals, ElementsAre(0, 0));
  EXPECT_EQ(snapshot.slots, std::vector<Event>(4));
}

TEST(ReferenceScarf, RingKeepsTheLastN) {
  const auto scarf = make(kOnePatch, {event(10, 0), event(20, 1), event(30, 2)});
  const auto snapshot = get(scarf->snapshot());
  EXPECT_THAT(snapshot.totals, ElementsAre(3));
  EXPECT_THAT(snapshot.slots, ElementsAre(event(30, 2), event(20, 1)));  // the third overwrote slot 0
  EXPECT_THAT(get(scarf->active_events()), ElementsAre(event(20, 1), event(30, 2)));
  EXPECT_THAT(get(scarf->count_image()).pixels, ElementsAre(0, 1, 1, 0));
}

TEST(ReferenceScarf, InactiveEventsAreStoredButNotShown) {
  const auto scarf = make(kTwoPatches, {event(1, 2), event(2, 3), event(3, 0)});
  const auto snapshot = get(scarf->snapshot());
  EXPECT_THAT(snapshot.totals, ElementsAre(3, 2));
  EXPECT_THAT(snapshot.slots, ElementsAre(event(3, 0), event(2, 3), event(1, 2), event(2, 3)));
  // Event x=2 is active in patch 0 only, and was pushed out there; in patch 1 it is stored and inactive.
  EXPECT_THAT(get(scarf->count_image()).pixels, ElementsAre(1, 0, 0, 1, 0, 0));
  EXPECT_THAT(get(scarf->active_events()), ElementsAre(event(3, 0), event(2, 3)));
}

TEST(ReferenceScarf, InactiveEventsPushOutActiveOnes) {
  const auto scarf = make(kTwoPatches, {event(1, 4), event(2, 2), event(3, 2)});
  EXPECT_THAT(get(scarf->count_image()).pixels, ElementsAre(0, 0, 2, 0, 0, 0));
}

TEST(ReferenceScarf, PartialLastCells) {
  // Cells of 4 on 6x5 pixels: the last column has two pixels, the last row one.
  const auto scarf = make(preset(Preset::light, {6, 5}, 4), {event(1, 5, 4), event(2, 0, 4), event(3, 5, 0)});
  const auto image = get(scarf->count_image());
  EXPECT_EQ(std::accumulate(image.pixels.begin(), image.pixels.end(), 0), 3);
  EXPECT_EQ(image.at(5, 4), 1);
  EXPECT_EQ(image.at(0, 4), 1);
  EXPECT_EQ(image.at(5, 0), 1);
  EXPECT_THAT(get(scarf->patch_events(3, true)), ElementsAre(event(1, 5, 4)));
}

TEST(ReferenceScarf, PixelsInNoActiveRegionAreZero) {
  // The active region is 2..3 of six pixels, the field all of them.
  const auto scarf = make({{6, 2, 2, 1, 2, 2}, kOneRow, 8}, {event(1, 0), event(2, 2), event(3, 5)});
  EXPECT_THAT(get(scarf->count_image()).pixels, ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_THAT(get(scarf->patch_events(0, false)), ElementsAre(event(1, 0), event(2, 2), event(3, 5)));
  EXPECT_THAT(get(scarf->patch_events(0, true)), ElementsAre(event(2, 2)));
}

TEST(ReferenceScarf, PolarityModes) {
  Geometry geometry = kOnePatch;
  geometry.capacity = 8;
  const auto scarf = make(geometry, {event(1, 0, 0, 1), event(2, 0, 0, 0), event(3, 1, 0, 0),
                                     event(4, 1, 0, 0), event(5, 3, 0, 1), event(6, 3, 0, 1)});
  EXPECT_THAT(get(scarf->count_image(PolarityMode::merged)).pixels, ElementsAre(2, 2, 0, 2));
  EXPECT_THAT(get(scarf->count_image(PolarityMode::difference)).pixels, ElementsAre(0, -2, 0, 2));
  const auto separate = get(scarf->count_image(PolarityMode::separate));
  EXPECT_EQ(separate.planes, 2);
  EXPECT_THAT(separate.pixels, ElementsAre(1, 2, 0, 0, 1, 0, 0, 2));  // OFF, then ON
  EXPECT_THAT(get(scarf->u8_planes(PolarityMode::separate)).pixels,
              ElementsAre(76, 153, 0, 0, 76, 0, 0, 153));
  EXPECT_THAT(get(scarf->float_image()).pixels, ElementsAre(0.6f, 0.6f, 0.0f, 0.6f));
  const auto refused_u8 = scarf->u8_planes(PolarityMode::difference).wait();
  ASSERT_FALSE(refused_u8.ok());
  EXPECT_EQ(refused_u8.error().code, ErrorCode::illegal_parameter);
  EXPECT_FALSE(scarf->float_planes(PolarityMode::difference).wait().ok());
}

TEST(ReferenceScarf, DenseImageUsesTheLevelsOfTheAccumulation) {
  Geometry geometry = kOnePatch;
  geometry.capacity = 8;
  auto scarf = make(geometry, 0.5);
  ASSERT_TRUE(scarf->push(std::vector{event(1, 1), event(2, 2), event(3, 2), event(4, 2)}).ok());
  EXPECT_THAT(get(scarf->u8_image()).pixels, ElementsAre(0, 128, 255, 0));  // 127.5 goes to the even 128
  EXPECT_THAT(get(scarf->float_image()).pixels, ElementsAre(0.0f, 0.5f, 1.5f, 0.0f));
}

TEST(ReferenceScarf, SparseOrders) {
  const auto scarf = make(kTwoPatches, {event(9, 4), event(5, 1), event(5, 5), event(2, 0)});
  EXPECT_THAT(get(scarf->active_events(EventOrder::by_patch)),
              ElementsAre(event(5, 1), event(2, 0), event(9, 4), event(5, 5)));
  // Equal times keep the patch order: t=5 of patch 0 before that of patch 1.
  EXPECT_THAT(get(scarf->active_events(EventOrder::by_time)),
              ElementsAre(event(2, 0), event(5, 1), event(5, 5), event(9, 4)));
}

TEST(ReferenceScarf, PatchQuery) {
  const auto scarf = make(kTwoPatches, {event(1, 5), event(2, 2), event(3, 3)});
  EXPECT_THAT(get(scarf->patch_events(1, false)), ElementsAre(event(2, 2), event(3, 3)));
  EXPECT_THAT(get(scarf->patch_events(1, true)), ElementsAre(event(3, 3)));
  for (const int64_t patch : {int64_t{-1}, int64_t{2}}) {
    const auto refused = scarf->patch_events(patch, false).wait();
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::illegal_parameter);
    EXPECT_THAT(refused.error().message,
                HasSubstr("patch is " + std::to_string(patch) + ", legal is 0 to 1"));
  }
}

TEST(ReferenceScarf, ResetIsAsNew) {
  const auto scarf = make(kTwoPatches, {event(1, 5), event(2, 2)});
  ASSERT_TRUE(scarf->reset().ok());
  EXPECT_EQ(digest(*scarf), digest(*make(kTwoPatches)));
  EXPECT_EQ(get(scarf->snapshot()).slots, std::vector<Event>(4));
  // The origin of time is new too: an event that the old stream would refuse.
  EXPECT_TRUE(scarf->push(std::vector{event(int64_t{1} << 60, 0)}).ok());
}

TEST(ReferenceScarf, EventsOutsideAreCountedAndDropped) {
  auto scarf = make(kTwoPatches);
  const auto report =
      scarf->push(std::vector{event(1, 6), event(2, 1), event(std::numeric_limits<int64_t>::max(), 0, 1, 7)});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->accepted, 3u);
  EXPECT_EQ(report->outside, 2u);
  EXPECT_THAT(get(scarf->snapshot()).totals, ElementsAre(1, 0));
}

TEST(ReferenceScarf, RefusedBatchStoresNothing) {
  const auto scarf = make(kTwoPatches, {event(100, 1)});
  const std::string before = digest(*scarf);
  const std::vector<Event> batches[] = {
      {event(101, 2), event(102, 3, 0, 2)},
      {event(101, 2), event(100 + (int64_t{1} << 48), 3)},
      {event(101, 2), event(100 - (int64_t{1} << 48), 3)},
  };
  for (const auto& batch : batches) {
    const auto report = scarf->push(batch);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::refused_batch);
    EXPECT_THAT(report.error().message, HasSubstr("event 1 of the batch"));
    EXPECT_EQ(digest(*scarf), before);
  }
}

TEST(ReferenceScarf, RefusedFirstBatchDoesNotSetTheOriginOfTime) {
  auto scarf = make(kTwoPatches);
  ASSERT_FALSE(scarf->push(std::vector{event(0, 0), event(0, 0, 0, 2)}).ok());
  EXPECT_TRUE(scarf->push(std::vector{event(int64_t{1} << 60, 0)}).ok());
}

TEST(ReferenceScarf, TimesComeBackExactly) {
  const int64_t unix_time = 1'700'000'000'000'000;  // near 2^51
  const std::vector<Event> events = {event(unix_time, 0), event(unix_time - (int64_t{1} << 48) + 1, 1)};
  EXPECT_EQ(get(make(kOnePatch, events)->active_events()), events);
}

TEST(ReferenceScarf, RefusesIllegalGeometryAndAccumulation) {
  Geometry geometry = kOnePatch;
  geometry.capacity = 0;
  EXPECT_FALSE(make_reference_scarf(geometry).ok());
  EXPECT_FALSE(make_reference_scarf(kOnePatch, 0.0).ok());
}

// Properties that hold for any stream and any geometry.
class ReferenceProperties : public ::testing::TestWithParam<Geometry> {
 protected:
  const Geometry geometry_ = GetParam();
  const std::vector<Event> events_ = random_events(geometry_.sensor(), 20'000, 3);
};

TEST_P(ReferenceProperties, BatchesDoNotMatter) {
  const auto whole = make(geometry_, events_);
  std::mt19937_64 random(4);
  for (const size_t largest : {1, 7, 5000}) {
    auto split = make(geometry_);
    for (size_t begin = 0; begin < events_.size();) {
      const size_t size = std::min<size_t>(random() % (largest + 1), events_.size() - begin);
      ASSERT_TRUE(split->push(std::span(events_).subspan(begin, size)).ok());
      begin += size;
      if (random() % 64 == 0) get(split->count_image());  // a query changes nothing
    }
    EXPECT_EQ(digest(*split), digest(*whole));
    EXPECT_EQ(get(split->snapshot()).slots, get(whole->snapshot()).slots);
  }
}

TEST_P(ReferenceProperties, SpeedDoesNotMatter) {
  std::vector<Event> slow = events_;
  for (Event& e : slow) e.t = 7 * e.t - 5;
  for (const auto mode : {PolarityMode::merged, PolarityMode::separate, PolarityMode::difference}) {
    EXPECT_EQ(get(make(geometry_, slow)->count_image(mode)),
              get(make(geometry_, events_)->count_image(mode)));
  }
}

TEST_P(ReferenceProperties, PolarityAndTimeDoNotAffectPlacement) {
  std::vector<Event> other = events_;
  for (Event& e : other) {
    e.p = 1 - e.p;
    e.t = -e.t;
  }
  const auto a = make(geometry_, events_);
  const auto b = make(geometry_, other);
  EXPECT_EQ(get(a->snapshot()).totals, get(b->snapshot()).totals);
  EXPECT_EQ(get(a->count_image()), get(b->count_image()));
}

TEST_P(ReferenceProperties, CountsAreTheSparseEvents) {
  const auto scarf = make(geometry_, events_);
  Image<int32_t> counts(geometry_.x.size, geometry_.y.size);
  for (const Event& e : get(scarf->active_events())) counts.pixels[e.y * counts.width + e.x] += 1;
  EXPECT_EQ(get(scarf->count_image()), counts);
  EXPECT_LE(*std::max_element(counts.pixels.begin(), counts.pixels.end()), geometry_.capacity);
  EXPECT_EQ(get(scarf->active_events(EventOrder::by_time)).size(), get(scarf->active_events()).size());
}

TEST_P(ReferenceProperties, TotalsCountTheEventsInEachField) {
  const auto snapshot = get(make(geometry_, events_)->snapshot());
  for (int64_t patch = 0; patch < geometry_.patches(); ++patch) {
    const auto in_field = [](const GridAxis& a, int64_t v, int64_t i) {
      return v >= a.origin + i * a.cell - a.margin_lo && v < a.origin + (i + 1) * a.cell + a.margin_hi;
    };
    const auto expected = std::count_if(events_.begin(), events_.end(), [&](const Event& e) {
      return in_field(geometry_.x, e.x, patch % geometry_.x.grid) &&
             in_field(geometry_.y, e.y, patch / geometry_.x.grid);
    });
    ASSERT_EQ(snapshot.totals[patch], static_cast<uint64_t>(expected));
  }
}

INSTANTIATE_TEST_SUITE_P(Geometries, ReferenceProperties,
                         ::testing::Values(preset(Preset::paper, {50, 40}, 9),
                                           preset(Preset::light, {50, 41}, 9),
                                           preset(Preset::light, {40, 40}, 4, 0.3),
                                           preset(Preset::event_driven, {61, 45}, 9),
                                           preset(Preset::event_driven_flex, {61, 45}, 7),
                                           Geometry{{37, 5, -8, 6, 3, 7}, {29, 6, 11, 9, 12, 0}, 13}));

TEST(ReferenceScarf, TranslationByWholeCellsPermutesPatches) {
  const int32_t cell = 5;
  const Geometry geometry = {{100, cell, 0, 20, 6, 4}, {80, cell, 0, 16, 3, 7}, 9};
  std::vector<Event> events = random_events({40, 30}, 5000, 5);
  for (Event& e : events) {
    e.x = static_cast<uint16_t>(e.x + 15);
    e.y = static_cast<uint16_t>(e.y + 15);
  }
  const int32_t cells_x = 6;
  const int32_t cells_y = 4;
  std::vector<Event> moved = events;
  for (Event& e : moved) {
    e.x = static_cast<uint16_t>(e.x + cells_x * cell);
    e.y = static_cast<uint16_t>(e.y + cells_y * cell);
  }
  const auto a = get(make(geometry, events)->snapshot());
  const auto b = get(make(geometry, moved)->snapshot());
  const auto counts_a = get(make(geometry, events)->count_image());
  const auto counts_b = get(make(geometry, moved)->count_image());
  for (int32_t j = 0; j + cells_y < geometry.y.grid; ++j) {
    for (int32_t i = 0; i + cells_x < geometry.x.grid; ++i) {
      const int32_t from = j * geometry.x.grid + i;
      const int32_t to = (j + cells_y) * geometry.x.grid + i + cells_x;
      ASSERT_EQ(a.totals[from], b.totals[to]);
      for (int64_t slot = 0; slot < a.filled(from); ++slot) {
        ASSERT_EQ(a.ring(from)[slot].t, b.ring(to)[slot].t);
        ASSERT_EQ(a.ring(from)[slot].x + cells_x * cell, b.ring(to)[slot].x);
        ASSERT_EQ(a.ring(from)[slot].y + cells_y * cell, b.ring(to)[slot].y);
      }
    }
  }
  for (int32_t y = 0; y + cells_y * cell < 80; ++y) {
    for (int32_t x = 0; x + cells_x * cell < 100; ++x) {
      ASSERT_EQ(counts_a.at(x, y), counts_b.at(x + cells_x * cell, y + cells_y * cell));
    }
  }
}

TEST(ReferenceScarf, CountImageIsAHistogramWhenNothingIsForgotten) {
  Geometry geometry = preset(Preset::paper, {30, 20}, 9);
  const auto events = random_events(geometry.sensor(), 4000, 6);
  geometry.capacity = 4000;
  Image<int32_t> histogram(30, 20);
  for (const Event& e : events) histogram.pixels[e.y * 30 + e.x] += 1;
  EXPECT_EQ(get(make(geometry, events)->count_image()), histogram);
}

}  // namespace
}  // namespace scarf
