#include "scarf/core/encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "core/encoding_tables.h"
#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr SensorSize kSensor = {4, 3};
constexpr float kUnit = 1.0F / (1 << 24);
constexpr auto kE2vid = VoxelGridParameters::Convention::e2vid;
constexpr auto kEventGan = VoxelGridParameters::Convention::eventgan;

__extension__ using Wide = unsigned __int128;

Event event(int64_t t, int32_t x, int32_t y = 0, uint8_t p = 1) {
  return {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), p};
}

Image<float> encoded(const EncodingParameters& parameters, const std::vector<Event>& events,
                     SensorSize sensor = kSensor) {
  auto image = encode(parameters, sensor, events);
  EXPECT_TRUE(image.ok()) << image.error().message;
  return std::move(*image);
}

// The values of one pixel in all planes.
std::vector<float> column(const Image<float>& image, int32_t x, int32_t y = 0) {
  std::vector<float> values;
  for (int32_t plane = 0; plane < image.planes; ++plane) values.push_back(image.at(x, y, plane));
  return values;
}

double sum(const Image<float>& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
}

std::vector<Event> random_events(SensorSize sensor, size_t count, uint64_t seed, int64_t step = 100) {
  std::mt19937_64 random(seed);
  std::vector<Event> events(count);
  int64_t t = -1'000;
  for (Event& e : events) {
    t += static_cast<int64_t>(random() % step) - step / 5;
    e = event(t, static_cast<int32_t>(random() % sensor.width),
              static_cast<int32_t>(random() % sensor.height), static_cast<uint8_t>(random() % 2));
  }
  return events;
}

std::vector<EncodingParameters> all_encodings() {
  return {VoxelGridParameters{},
          VoxelGridParameters{1},
          VoxelGridParameters{3, kEventGan},
          ToreParameters{},
          ToreParameters{1},
          EventImageParameters{},
          TimeSurfaceParameters{500},
          HatsParameters{3, 1, 1000, 500},
          HatsParameters{5, 0, 1000, 500},
          HotsParameters{3, 2, 700},
          HotsParameters{16'384, 1, 700}};
}

TEST(Encodings, ShapesAndEventsOutside) {
  const SensorSize sensor = {7, 5};
  const auto events = random_events(sensor, 200, 1);
  std::vector<Event> more = {event(-1'000'000, 7, 0)};  // would be the first event
  more.insert(more.end(), events.begin(), events.end());
  more.push_back(event(1'000'000, 0, 5, 9));  // would be the last
  for (const EncodingParameters& parameters : all_encodings()) {
    const auto image = encoded(parameters, events, sensor);
    EXPECT_EQ((EncodingShape{image.planes, image.height, image.width}), shape_of(parameters, sensor));
    EXPECT_EQ(encoded(parameters, more, sensor), image) << info_of(parameters).name;
  }
  EXPECT_EQ(shape_of(VoxelGridParameters{5, kE2vid}, sensor), (EncodingShape{5, 5, 7}));
  EXPECT_EQ(shape_of(VoxelGridParameters{5, kEventGan}, sensor), (EncodingShape{10, 5, 7}));
  EXPECT_EQ(shape_of(ToreParameters{8}, sensor), (EncodingShape{16, 5, 7}));
  EXPECT_EQ(shape_of(EventImageParameters{}, sensor), (EncodingShape{4, 5, 7}));
  EXPECT_EQ(shape_of(TimeSurfaceParameters{}, sensor), (EncodingShape{2, 5, 7}));
  EXPECT_EQ(shape_of(HatsParameters{3, 1}, sensor), (EncodingShape{18, 2, 3}));
  EXPECT_EQ(shape_of(HotsParameters{5, 2}, sensor), (EncodingShape{50, 1, 2}));
}

TEST(Encodings, NoEvents) {
  for (const EncodingParameters& parameters : all_encodings()) {
    const bool tore = std::holds_alternative<ToreParameters>(parameters);
    EXPECT_THAT(encoded(parameters, {}).pixels, Each(tore ? tore_value(kToreOldest) : 0.0F));
  }
}

TEST(Encodings, OrderDoesNotMatter) {
  const SensorSize sensor = {8, 6};
  auto events = random_events(sensor, 2'000, 2, 20);  // many equal times
  std::vector<Image<float>> images;
  for (const EncodingParameters& parameters : all_encodings())
    images.push_back(encoded(parameters, events, sensor));
  std::mt19937_64 random(5);
  std::shuffle(events.begin(), events.end(), random);
  for (size_t i = 0; i < images.size(); ++i)
    EXPECT_EQ(encoded(all_encodings()[i], events, sensor), images[i]);
}

TEST(Encodings, TimesAreRelative) {
  const SensorSize sensor = {8, 6};
  auto events = random_events(sensor, 500, 3);
  std::vector<Image<float>> images;
  for (const EncodingParameters& parameters : all_encodings())
    images.push_back(encoded(parameters, events, sensor));
  const int64_t largest =
      std::max_element(events.begin(), events.end(), [](auto& a, auto& b) { return a.t < b.t; })->t;
  for (Event& e : events) e.t += INT64_MAX - largest;
  for (size_t i = 0; i < images.size(); ++i)
    EXPECT_EQ(encoded(all_encodings()[i], events, sensor), images[i]);
}

TEST(VoxelGrid, LinearSplit) {
  // 3 bins over 0..100 us: 30 us is at 0.6, 0.6 * 2^24 = 10066329.6; 100 us is at 2, the last bin.
  const auto image = encoded(
      VoxelGridParameters{3},
      {event(0, 0, 0, 1), event(30, 1, 1, 1), event(30, 2, 1, 0), event(50, 3, 1, 0), event(100, 3, 2, 1)});
  EXPECT_THAT(column(image, 0, 0), ElementsAre(1, 0, 0));
  EXPECT_THAT(column(image, 1, 1), ElementsAre(6710886 * kUnit, 10066330 * kUnit, 0));
  EXPECT_THAT(column(image, 2, 1), ElementsAre(-6710886 * kUnit, -10066330 * kUnit, 0));
  EXPECT_THAT(column(image, 3, 1), ElementsAre(0, -1, 0));
  EXPECT_THAT(column(image, 3, 2), ElementsAre(0, 0, 1));
  EXPECT_EQ(sum(image), 1.0);
}

TEST(VoxelGrid, EventGanKeepsPolaritiesApart) {
  // The same events: planes 0..2 are those of ON, 3..5 those of OFF.
  const auto image = encoded(VoxelGridParameters{3, kEventGan}, {event(0, 0, 0, 1), event(30, 1, 1, 1),
                                                                 event(30, 1, 1, 0), event(100, 3, 2, 0)});
  EXPECT_THAT(column(image, 0, 0), ElementsAre(1, 0, 0, 0, 0, 0));
  EXPECT_THAT(column(image, 1, 1),
              ElementsAre(6710886 * kUnit, 10066330 * kUnit, 0, 6710886 * kUnit, 10066330 * kUnit, 0));
  EXPECT_THAT(column(image, 3, 2), ElementsAre(0, 0, 0, 0, 0, 1));
}

TEST(VoxelGrid, OneTimeOrOneBin) {
  const auto same = encoded(VoxelGridParameters{4}, {event(7, 1), event(7, 1), event(7, 2, 0, 0)});
  EXPECT_THAT(column(same, 1), ElementsAre(2, 0, 0, 0));
  EXPECT_THAT(column(same, 2), ElementsAre(-1, 0, 0, 0));
  const auto one_bin =
      encoded(VoxelGridParameters{1}, {event(0, 1), event(5, 1), event(9, 1, 0, 0), event(9, 2)});
  EXPECT_THAT(column(one_bin, 1), ElementsAre(1));
  EXPECT_THAT(column(one_bin, 2), ElementsAre(1));
}

TEST(VoxelGrid, HalvesAreRoundedToEven) {
  // Of 2^25 us, 1 us is half a unit and becomes 0; 3 us is 1.5 and becomes 2; 5 us is 2.5 and becomes 2.
  const auto image = encoded(VoxelGridParameters{2},
                             {event(0, 3), event(1, 0), event(3, 1), event(5, 2), event(1 << 25, 3, 1)});
  EXPECT_EQ(image.at(0, 0, 1), 0);
  EXPECT_EQ(image.at(0, 0, 0), 1);
  EXPECT_EQ(image.at(1, 0, 1), 2 * kUnit);
  EXPECT_EQ(image.at(1, 0, 0), 1 - 2 * kUnit);
  EXPECT_EQ(image.at(2, 0, 1), 2 * kUnit);
}

// The definition in 128 bits: sums of weights per (plane, y, x).
std::map<std::tuple<int32_t, int32_t, int32_t>, int64_t> voxels(const VoxelGridParameters& p,
                                                                const std::vector<Event>& events) {
  uint64_t first = UINT64_MAX;  // times as if unsigned: 2^63 later, which no difference sees
  uint64_t last = 0;
  const auto shifted = [](int64_t t) { return static_cast<uint64_t>(t) ^ (uint64_t{1} << 63); };
  for (const Event& e : events) {
    first = std::min(first, shifted(e.t));
    last = std::max(last, shifted(e.t));
  }
  int unit = 0;
  while ((last - first) >> unit >= uint64_t{1} << 40) ++unit;
  const Wide length = (last - first) >> unit;
  std::map<std::tuple<int32_t, int32_t, int32_t>, int64_t> sums;
  for (const Event& e : events) {
    const Wide place = Wide(p.bins - 1) * ((shifted(e.t) - first) >> unit);
    const auto bin = static_cast<int32_t>(length == 0 ? 0 : place / length);
    const Wide scaled = length == 0 ? 0 : (place % length) << 24;
    // floor(scaled / length + 1/2), and one less where that was an exact half above an even number
    Wide right = length == 0 ? 0 : (2 * scaled + length) / (2 * length);
    if (length != 0 && (2 * scaled + length) % (2 * length) == 0 && right % 2 == 1) --right;
    const bool apart = p.convention == kEventGan;
    const int32_t plane = bin + (apart && e.p == 0 ? p.bins : 0);
    const int64_t sign = apart || e.p == 1 ? 1 : -1;
    sums[{plane, e.y, e.x}] += sign * ((int64_t{1} << 24) - static_cast<int64_t>(right));
    if (right != 0) sums[{plane + 1, e.y, e.x}] += sign * static_cast<int64_t>(right);
  }
  return sums;
}

TEST(VoxelGrid, AnySpanOfTime) {
  for (int bits = 0; bits < 64; ++bits) {
    for (const VoxelGridParameters& p : {VoxelGridParameters{5}, VoxelGridParameters{256, kEventGan}}) {
      std::mt19937_64 random(bits);
      auto events = random_events(kSensor, 60, bits);
      for (Event& e : events) e.t = static_cast<int64_t>(random()) >> (63 - bits);
      if (bits == 63) {
        events.front().t = INT64_MIN;
        events.back().t = INT64_MAX;
      }
      const auto image = encoded(p, events);
      Image<float> expected(kSensor.width, kSensor.height, image.planes);
      for (const auto& [place, value] : voxels(p, events)) {
        const auto& [plane, y, x] = place;
        ASSERT_LT(plane, image.planes);
        expected.pixels[(static_cast<size_t>(plane) * kSensor.height + y) * kSensor.width + x] =
            static_cast<float>(static_cast<double>(value) / (1 << 24));
      }
      EXPECT_EQ(image, expected) << bits;
    }
  }
}

TEST(VoxelGrid, WeightsSumToPolarities) {
  // One event per pixel, so that no sum is rounded.
  const SensorSize sensor = {40, 30};
  std::mt19937_64 random(4);
  std::vector<Event> events;
  double polarities = 0;
  for (int32_t i = 0; i < sensor.width * sensor.height; ++i) {
    events.push_back(event(static_cast<int64_t>(random() % 1'000'003), i % sensor.width, i / sensor.width,
                           static_cast<uint8_t>(random() % 2)));
    polarities += events.back().p == 1 ? 1 : -1;
  }
  for (const int32_t bins : {1, 2, 5, 15, 256}) {
    EXPECT_EQ(sum(encoded(VoxelGridParameters{bins}, events, sensor)), polarities);
    EXPECT_EQ(sum(encoded(VoxelGridParameters{bins, kEventGan}, events, sensor)), events.size());
  }
}

TEST(Tore, NewestAgesInOrder) {
  const int64_t t = 10'000'000;
  const auto value = [](double d) { return static_cast<float>(std::log(d + 1) - std::log(151.0)); };
  const float never = value(5e6);
  const auto image =
      encoded(ToreParameters{3}, {event(t - 2'000, 1), event(t - 151, 1), event(t - 4'000, 1),
                                  event(t - 700, 1), event(t - 150, 2, 0, 0), event(t, 2, 0, 0),
                                  event(t - 5'000'000, 3), event(t - 4'999'999, 3), event(t - 6'000'000, 3)});
  // ON newest to oldest, then OFF; the fourth event of pixel 1 is forgotten.
  EXPECT_THAT(column(image, 1), ElementsAre(value(151), value(700), value(2'000), never, never, never));
  // Up to 150 us the value is 0.
  EXPECT_THAT(column(image, 2), ElementsAre(never, never, never, 0, 0, never));
  // Older than 5 s is as 5 s, and as never.
  EXPECT_THAT(column(image, 3), ElementsAre(value(4'999'999), never, never, never, never, never));
  EXPECT_THAT(column(image, 0), Each(never));
  EXPECT_NEAR(never, 10.4076, 1e-4);
}

TEST(Tore, Table) {
  const auto table = tore_table();
  ASSERT_EQ(table.size(), 5'000'001);
  EXPECT_EQ(table[0], 0);
  EXPECT_EQ(table[150], 0);
  EXPECT_GT(table[151], 0);
  EXPECT_TRUE(std::is_sorted(table.begin(), table.end()));
  for (const uint64_t age : {0, 149, 150, 151, 4'000, 4'999'999, 5'000'000})
    EXPECT_EQ(table[age], tore_value(age));
  EXPECT_EQ(tore_value(5'000'001), table.back());
  EXPECT_EQ(tore_value(UINT64_MAX), table.back());
}

TEST(EventImage, CountsAndLastTimes) {
  const auto image = encoded(
      EventImageParameters{},
      {event(100, 1), event(130, 1), event(120, 1), event(140, 1, 0, 0), event(200, 2), event(100, 3, 0, 0)});
  // 30 / 100 and 40 / 100 in units of 2^-24: 5033164.8 and 6710886.4.
  EXPECT_THAT(column(image, 1), ElementsAre(3, 1, 5033165 * kUnit, 6710886 * kUnit));
  EXPECT_THAT(column(image, 2), ElementsAre(1, 0, 1, 0));
  EXPECT_THAT(column(image, 3), ElementsAre(0, 1, 0, 0));  // the first event of all has the time 0
  EXPECT_THAT(column(image, 0), ElementsAre(0, 0, 0, 0));
}

TEST(EventImage, OneTimeIsTheLastTime) {
  const auto image = encoded(EventImageParameters{}, {event(5, 1), event(5, 1)});
  EXPECT_THAT(column(image, 1), ElementsAre(2, 0, 1, 0));
}

TEST(EventImage, WholeRangeOfTimes) {
  const auto image = encoded(EventImageParameters{}, {event(INT64_MIN, 1), event(0, 2), event(INT64_MAX, 3)});
  EXPECT_EQ(image.at(1, 0, 2), 0);
  EXPECT_EQ(image.at(2, 0, 2), 0.5F);
  EXPECT_EQ(image.at(3, 0, 2), 1);
}

TEST(TimeSurface, DecaysSinceTheLastEvent) {
  const auto image =
      encoded(TimeSurfaceParameters{100}, {event(0, 1), event(150, 1), event(50, 1), event(200, 2, 0, 0)});
  // exp(-0.5) * 2^24 = 10175895.9
  EXPECT_THAT(column(image, 1), ElementsAre(10175896 * kUnit, 0));
  EXPECT_THAT(column(image, 2), ElementsAre(0, 1));
  EXPECT_THAT(column(image, 0), ElementsAre(0, 0));
}

// The sum of some decay weights over a number of events.
float mean(const std::vector<double>& exponents, int32_t count) {
  int64_t total = 0;
  for (const double exponent : exponents) total += std::llrint(std::exp(-exponent) * (1 << 24));
  return static_cast<float>(static_cast<double>(total) / (static_cast<double>(count) * (1 << 24)));
}

TEST(Hats, CellsPolaritiesAndWindow) {
  // Two cells of 4 x 4. Radius 1: planes of ON are 0..8, of which 4 is the pixel itself and 3 its left
  // neighbour; OFF are 9..17.
  const SensorSize sensor = {8, 4};
  const auto image = encoded(HatsParameters{4, 1, 100, 100},
                             {event(0, 1, 1), event(50, 2, 1), event(150, 2, 1), event(151, 2, 2),
                              event(52, 2, 1, 0), event(155, 3, 2), event(160, 4, 2), event(160, 4, 2)},
                             sensor);
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 1);
  std::vector<float> expected(18, 0.0F);
  // Cell 0 has six events, the OFF one among them, which sees nothing.
  //   t 50 at (2,1) sees t 0 at its left; t 150 at (2,1) sees t 50 on its own pixel, of age 100 exactly, but
  //   t 0 no more. t 151 at (2,2) sees t 150 above it, not t 50. t 155 at (3,2) sees t 151 at its left and
  //   t 150 at its upper left.
  expected[3] = mean({0.5, 0.04}, 6);
  expected[4] = mean({1.0}, 6);
  expected[1] = mean({0.01}, 6);
  expected[0] = mean({0.05}, 6);
  EXPECT_EQ(column(image, 0), expected);
  // Cell 1 does not see cell 0, nor do events of the same time see each other.
  EXPECT_THAT(column(image, 1), Each(0.0F));
}

TEST(Hats, EveryEarlierEventCounts) {
  const auto image =
      encoded(HatsParameters{10, 0, 100, 1000}, {event(0, 1, 0, 0), event(10, 1, 0, 0), event(40, 1, 0, 0)});
  EXPECT_THAT(column(image, 0), ElementsAre(0, mean({0.1, 0.4, 0.3}, 3)));
}

TEST(Hots, SurfacesOfTheLastEvents) {
  // One cell; radius 1. Each event sees itself.
  const auto image = encoded(HotsParameters{10, 1, 100},
                             {event(0, 1, 1), event(50, 2, 1), event(70, 2, 1), event(80, 1, 1, 0)});
  // Planes of ON neighbours 0..8: 4 the pixel itself, 3 the left one, 5 the right one. OFF neighbours 9..17.
  std::vector<float> expected(18, 0.0F);
  expected[4] = mean({0, 0, 0, 0.8}, 4);  // t 80 is OFF: the ON event on its pixel is 80 us old
  expected[3] = mean({0.5, 0.7}, 4);
  expected[5] = mean({0.1}, 4);  // t 80 sees t 70, and t 50 no more
  expected[13] = mean({0}, 4);
  EXPECT_EQ(column(image, 0), expected);
}

TEST(Hots, NeighboursBeyondTheCellAndEqualTimes) {
  // Cells of 2 columns: pixels 1 and 2 are in different cells and see each other.
  const auto image = encoded(HotsParameters{2, 1, 100}, {event(5, 1), event(5, 2)});
  EXPECT_EQ(image.at(0, 0, 4), 1);
  EXPECT_EQ(image.at(0, 0, 5), 1);
  EXPECT_EQ(image.at(1, 0, 4), 1);
  EXPECT_EQ(image.at(1, 0, 3), 1);
  EXPECT_EQ(sum(image), 4);
}

TEST(Encodings, IllegalInput) {
  const auto error = [](const EncodingParameters& parameters, SensorSize sensor = kSensor,
                        std::vector<Event> events = {}) {
    const auto image = encode(parameters, sensor, events);
    EXPECT_FALSE(image.ok());
    return image.ok() ? Error{} : image.error();
  };
  EXPECT_EQ(error(VoxelGridParameters{0}).message, "voxel_grid: bins is 0, legal is 1 to 256");
  EXPECT_EQ(error(VoxelGridParameters{257}).code, ErrorCode::illegal_parameter);
  EXPECT_EQ(error(VoxelGridParameters{5, static_cast<VoxelGridParameters::Convention>(2)}).message,
            "voxel_grid: convention is 2, legal is e2vid, eventgan");
  EXPECT_EQ(error(ToreParameters{65}).message, "tore: k is 65, legal is 1 to 64");
  EXPECT_THAT(error(TimeSurfaceParameters{0}).message, HasSubstr("tau is 0s, legal is 1us to 1000s"));
  EXPECT_EQ(error(HatsParameters{0}).message, "hats: cell is 0, legal is 1 to 16384");
  EXPECT_EQ(error(HatsParameters{1, 17}).message, "hats: radius is 17, legal is 0 to 16");
  EXPECT_EQ(error(HotsParameters{1, -1}).message, "hots: radius is -1, legal is 0 to 16");
  EXPECT_EQ(error(ToreParameters{}, {0, 1}).message, "sensor is 0x1, legal is 1 to 16384 pixels per axis");
  const Error polarity = error(ToreParameters{}, kSensor, {event(0, 1), event(3, 2, 1, 2)});
  EXPECT_EQ(polarity.code, ErrorCode::refused_batch);
  EXPECT_EQ(polarity.message,
            "event 1 (t 3, x 2, y 1, p 2): the polarity must be 0 or 1; nothing was encoded");
}

TEST(ParseEncoding, Words) {
  const auto voxels = parse_encoding("voxel_grid:bins=15,convention=eventgan");
  ASSERT_TRUE(voxels.ok());
  EXPECT_EQ(std::get<VoxelGridParameters>(*voxels).bins, 15);
  EXPECT_EQ(std::get<VoxelGridParameters>(*voxels).convention, kEventGan);
  const auto tore = parse_encoding("tore");
  ASSERT_TRUE(tore.ok());
  EXPECT_EQ(std::get<ToreParameters>(*tore).k, 8);
  const auto hats = parse_encoding("hats:window=30ms,radius=0,tau=7,cell=16384");
  ASSERT_TRUE(hats.ok());
  EXPECT_EQ(std::get<HatsParameters>(*hats).window, 30'000);
  EXPECT_EQ(std::get<HatsParameters>(*hats).radius, 0);
  EXPECT_EQ(std::get<HatsParameters>(*hats).tau, 7);
  EXPECT_EQ(std::get<HatsParameters>(*hats).cell, 16'384);
  EXPECT_TRUE(parse_encoding("event_image").ok());
}

TEST(ParseEncoding, ErrorsNameWhatIsLegal) {
  const auto message = [](const std::string& words) {
    const auto parsed = parse_encoding(words);
    EXPECT_FALSE(parsed.ok()) << words;
    return parsed.ok() ? "" : parsed.error().message;
  };
  EXPECT_EQ(
      message("voxel"),
      "encoding 'voxel' is unknown; use one of voxel_grid, tore, event_image, time_surface, hats, hots");
  EXPECT_EQ(message("voxel_grid:bins=many"), "voxel_grid: bins is 'many', legal is 1 to 256");
  EXPECT_EQ(message("voxel_grid:convention=E2VID"),
            "voxel_grid: convention is 'E2VID', legal is e2vid, eventgan");
  EXPECT_EQ(message("event_image:bins=1"), "event_image: parameter 'bins' is unknown; there is none");
  EXPECT_EQ(message("tore:bins=1"), "tore: parameter 'bins' is unknown; use one of k");
  EXPECT_THAT(message("hots:tau=1m"), HasSubstr("tau is '1m', legal is 1us to 1000s"));
}

TEST(EncodingInfos, DefaultsParse) {
  ASSERT_EQ(encodings().size(), std::variant_size_v<EncodingParameters>);
  for (size_t i = 0; i < encodings().size(); ++i) {
    const EncodingInfo& info = encodings()[i];
    EXPECT_FALSE(info.title.empty() || info.description.empty());
    std::string words = info.name;
    for (const ParameterInfo& parameter : info.parameters) {
      words += (words == info.name ? ":" : ",") + parameter.name + "=" + parameter.value;
    }
    const auto parsed = parse_encoding(words);
    ASSERT_TRUE(parsed.ok()) << parsed.error().message;
    EXPECT_EQ(parsed->index(), i);
    EXPECT_EQ(info_of(*parsed).name, info.name);
    EXPECT_EQ(info.cpu_only, info.name == "hats" || info.name == "hots");
  }
  EXPECT_EQ(encodings()[0].parameters[1].value, "e2vid");
  EXPECT_EQ(encodings()[0].parameters[1].range, "e2vid, eventgan");
}

}  // namespace
}  // namespace scarf
