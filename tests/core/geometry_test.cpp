#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

PresetParameters given(std::optional<int32_t> cell, std::optional<double> ratio = {},
                       std::optional<double> alpha = {}) {
  return {cell, ratio, alpha};
}

// GridAxis fields in order: size, cell, origin, grid, margin_lo, margin_hi.
struct PresetCase {
  const char* name;
  Preset preset;
  SensorSize sensor;
  PresetParameters parameters;
  Geometry expected;
};

// Worked out by hand from the definition of each preset.
const PresetCase kPresetCases[] = {
    {"paper_small", Preset::paper, {240, 180}, {}, {{240, 9, 0, 27, 10, 11}, {180, 9, 0, 20, 10, 11}, 233}},
    {"paper_hd", Preset::paper, {1280, 720}, {}, {{1280, 9, 0, 143, 10, 11}, {720, 9, 0, 80, 10, 11}, 233}},
    {"paper_tiny", Preset::paper, {1, 10}, {}, {{1, 9, 0, 1, 10, 11}, {10, 9, 0, 2, 10, 11}, 233}},
    // k*r = 10 exactly: the strict inequalities exclude both end points. N = 2 * 10 * 10.
    {"paper_integer_reach",
     Preset::paper,
     {20, 21},
     given(5, 2.0),
     {{20, 5, 0, 4, 9, 10}, {21, 5, 0, 5, 9, 10}, 200}},
    // k*r = 2.7, N = floor(0.5 * 7.29).
    {"paper_narrow",
     Preset::paper,
     {18, 9},
     given({}, 0.3, 0.5),
     {{18, 9, 0, 2, 2, 3}, {9, 9, 0, 1, 2, 3}, 3}},
    {"light_small", Preset::light, {240, 180}, {}, {{240, 9, 0, 27, 4, 4}, {180, 9, 0, 20, 4, 4}, 81}},
    {"light_hd", Preset::light, {1280, 720}, {}, {{1280, 9, 0, 143, 4, 4}, {720, 9, 0, 80, 4, 4}, 81}},
    {"light_tiny", Preset::light, {3, 2}, {}, {{3, 9, 0, 1, 4, 4}, {2, 9, 0, 1, 4, 4}, 81}},
    {"light_even", Preset::light, {16, 17}, given(8), {{16, 8, 0, 2, 4, 4}, {17, 8, 0, 3, 4, 4}, 64}},
    {"light_one", Preset::light, {2, 1}, given(1), {{2, 1, 0, 2, 0, 0}, {1, 1, 0, 1, 0, 0}, 1}},
    // k = 9 is raised to 10; 240/10 - 1 = 23 cells of 240/24 = 10 pixels; N = 10 * 10 * 2 * 0.5.
    {"event_driven_small",
     Preset::event_driven,
     {240, 180},
     {},
     {{240, 10, 5, 23, 5, 5}, {180, 10, 5, 17, 5, 5}, 100}},
    {"event_driven_hd",
     Preset::event_driven,
     {1280, 720},
     {},
     {{1280, 10, 5, 127, 5, 5}, {720, 10, 5, 71, 5, 5}, 100}},
    {"event_driven_smallest",
     Preset::event_driven,
     {20, 20},
     {},
     {{20, 10, 5, 1, 5, 5}, {20, 10, 5, 1, 5, 5}, 100}},
    // x: 38/10 - 1 = 2, 38/3 = 12. y: 55/10 - 1 = 4, 55/5 = 11, lowered to 10. N = 12 * 10.
    {"event_driven_axes",
     Preset::event_driven,
     {38, 55},
     {},
     {{38, 12, 6, 2, 6, 6}, {55, 10, 5, 4, 5, 5}, 120}},
    // N = floor(9 * 2.2 * 9 * 2.2 * 2 / 4.5) = floor(174.24).
    {"flex_small",
     Preset::event_driven_flex,
     {240, 180},
     {},
     {{240, 9, 0, 26, 10, 10}, {180, 9, 0, 20, 10, 10}, 174}},
    {"flex_hd",
     Preset::event_driven_flex,
     {1280, 720},
     {},
     {{1280, 9, 0, 142, 10, 10}, {720, 9, 0, 80, 10, 10}, 174}},
    // x: 35/9 = 3 cells of 11. y: 26/9 = 2 cells of 13. N = floor(11 * 2.2 * 13 * 2.2 * 2 / 4.5) =
    // floor(307.6).
    {"flex_axes",
     Preset::event_driven_flex,
     {35, 26},
     {},
     {{35, 11, 0, 3, 13, 13}, {26, 13, 0, 2, 15, 15}, 307}},
};

void PrintTo(const PresetCase& c, std::ostream* out) {
  *out << c.name;
}

class Presets : public ::testing::TestWithParam<PresetCase> {};

TEST_P(Presets, AreAsWorkedOutByHand) {
  const auto& c = GetParam();
  const auto geometry = make_geometry(c.preset, c.sensor, c.parameters);
  ASSERT_TRUE(geometry.ok()) << geometry.error().message;
  EXPECT_EQ(*geometry, c.expected) << to_string(*geometry) << "\n" << to_string(c.expected);
  EXPECT_EQ(geometry->sensor(), c.sensor);
}

INSTANTIATE_TEST_SUITE_P(Geometry, Presets, ::testing::ValuesIn(kPresetCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Geometry, LargestPaperCellFitsTheField) {
  // Field = 4 + 119 + 5 = 128: the largest that is legal; one more pixel is refused.
  EXPECT_TRUE(make_geometry(Preset::paper, {640, 480}, given(119, 0.04)).ok());
  const auto larger = make_geometry(Preset::paper, {640, 480}, given(120, 0.04));
  ASSERT_FALSE(larger.ok());
  EXPECT_THAT(larger.error().message, HasSubstr("receptive field x is 129, legal is 1 to 128"));
}

// Sum over all pixels of the number of patches that hold them.
int64_t holders(const GridAxis& axis) {
  int64_t sum = 0;
  for (int32_t v = 0; v < axis.size; ++v) {
    const PatchRange range = axis.patches_holding(v);
    sum += range.last - range.first + 1;
  }
  return sum;
}

double mean_buffers(const Geometry& g) {
  return static_cast<double>(holders(g.x) * holders(g.y)) / (static_cast<double>(g.x.size) * g.y.size);
}

TEST(Geometry, MeanBuffersPerEvent) {
  // Clipped field sizes, summed by hand. paper, x: 20 + 29 + 67 * 30 + 29 + 20 + 11; y: 20 + 29 + 49 * 30 +
  // ...
  const auto paper = make_geometry(Preset::paper, {640, 480});
  ASSERT_TRUE(paper.ok());
  EXPECT_EQ(holders(paper->x), 2119);
  EXPECT_EQ(holders(paper->y), 20 + 29 + 49 * 30 + 30 + 22 + 13);
  EXPECT_NEAR(mean_buffers(*paper), 10.9, 0.05);

  const auto light = make_geometry(Preset::light, {640, 480});
  ASSERT_TRUE(light.ok());
  EXPECT_EQ(holders(light->x), 13 + 69 * 17 + 14 + 5);
  EXPECT_EQ(holders(light->y), 13 + 51 * 17 + 16 + 7);
  EXPECT_NEAR(mean_buffers(*light), 3.5, 0.05);
}

TEST(Geometry, PatchesHoldingAndActiveAgreeWithTheDefinition) {
  std::mt19937_64 random(1);
  const auto between = [&random](int32_t low, int32_t high) {
    return low + static_cast<int32_t>(random() % static_cast<uint64_t>(high - low + 1));
  };
  for (int round = 0; round < 3000; ++round) {
    GridAxis a;
    a.size = between(1, 80);
    a.cell = between(1, 20);
    a.grid = between(1, 30);
    a.origin = between(-150, a.size + 50);
    a.margin_lo = between(0, 40);
    a.margin_hi = between(0, 40);
    ASSERT_TRUE(checked_geometry({a, a, 1}).ok());
    for (int32_t v = 0; v < a.size; ++v) {
      const PatchRange range = a.patches_holding(v);
      for (int32_t i = 0; i < a.grid; ++i) {
        const int32_t begin = a.origin + i * a.cell;
        const int32_t end = begin + a.cell;
        const bool held = v >= begin - a.margin_lo && v < end + a.margin_hi;
        ASSERT_EQ(i >= range.first && i <= range.last, held)
            << "pixel " << v << " patch " << i << " of " << to_string({a, a, 1});
        ASSERT_EQ(a.active(v, i), v >= begin && v < end);
        ASSERT_TRUE(held || !a.active(v, i));
      }
    }
  }
}

TEST(Geometry, FieldBeginIsTheOriginOfLocalCoordinates) {
  const GridAxis a = {100, 9, -3, 12, 10, 11};
  EXPECT_EQ(a.field(), 30);
  EXPECT_EQ(a.field_begin(0), -13);
  EXPECT_EQ(a.field_begin(2), 5);
}

struct RefusedPreset {
  const char* name;
  Preset preset;
  SensorSize sensor;
  PresetParameters parameters;
  std::vector<std::string> says;  // parameter, value, legal range
};

const RefusedPreset kRefusedPresets[] = {
    {"width_0", Preset::paper, {0, 180}, {}, {"sensor width is 0", "1 to 16384"}},
    {"height_negative", Preset::light, {240, -1}, {}, {"sensor height is -1", "1 to 16384"}},
    {"width_large", Preset::paper, {16385, 180}, {}, {"sensor width is 16385", "1 to 16384"}},
    {"cell_0", Preset::paper, {240, 180}, given(0), {"cell is 0", "1 to 128"}},
    {"cell_large", Preset::light, {240, 180}, given(129), {"cell is 129", "1 to 128"}},
    {"ratio_negative", Preset::paper, {240, 180}, given({}, -0.5), {"ratio is -0.5", ">= 0"}},
    {"ratio_nan", Preset::paper, {240, 180}, given({}, kNan), {"ratio is nan", "finite"}},
    {"ratio_inf", Preset::event_driven_flex, {240, 180}, given({}, kInf), {"ratio is inf", "finite"}},
    {"alpha_0", Preset::paper, {240, 180}, given({}, {}, 0.0), {"alpha is 0", "> 0"}},
    {"alpha_negative", Preset::light, {240, 180}, given({}, {}, -1.0), {"alpha is -1", "> 0"}},
    {"alpha_nan", Preset::event_driven, {240, 180}, given({}, {}, kNan), {"alpha is nan", "finite"}},
    {"alpha_inf", Preset::light, {240, 180}, given({}, {}, kInf), {"alpha is inf", "finite"}},
    {"light_ratio", Preset::light, {240, 180}, given({}, 1.2), {"ratio 1.2", "light", "does not use"}},
    {"event_driven_ratio", Preset::event_driven, {240, 180}, given({}, 1.2), {"ratio 1.2", "does not use"}},
    {"paper_ratio_0", Preset::paper, {240, 180}, given({}, 0.0), {"ratio 0", "at least 1"}},
    {"paper_ratio_large", Preset::paper, {240, 180}, given({}, 100.0), {"ratio 100", "128"}},
    {"paper_ratio_huge", Preset::paper, {240, 180}, given({}, 1e300), {"ratio 1e+300", "128"}},
    {"flex_ratio_large", Preset::event_driven_flex, {240, 180}, given({}, 1e300), {"ratio 1e+300", "128"}},
    {"event_driven_cell", Preset::event_driven, {640, 480}, given(65), {"receptive field x", "128"}},
    {"capacity_large",
     Preset::light,
     {240, 180},
     given({}, {}, 2000.0),
     {"alpha 2000", "81000", "1 to 65535"}},
    {"capacity_huge", Preset::light, {240, 180}, given({}, {}, 1e300), {"alpha 1e+300", "1 to 65535"}},
    {"capacity_0", Preset::light, {240, 180}, given({}, {}, 0.001), {"alpha 0.001", "is 0", "1 to 65535"}},
    {"event_driven_width", Preset::event_driven, {19, 20}, {}, {"19x20", "smallest is 20x20"}},
    {"event_driven_height", Preset::event_driven, {20, 19}, {}, {"20x19", "smallest is 20x20"}},
    {"flex_sensor", Preset::event_driven_flex, {9, 8}, {}, {"9x8", "smallest is 9x9"}},
    {"explicit", Preset::explicit_, {240, 180}, {}, {"explicit", "checked_geometry"}},
};

void PrintTo(const RefusedPreset& c, std::ostream* out) {
  *out << c.name;
}

class Refused : public ::testing::TestWithParam<RefusedPreset> {};

TEST_P(Refused, NamesParameterValueAndRange) {
  const auto& c = GetParam();
  const auto geometry = make_geometry(c.preset, c.sensor, c.parameters);
  ASSERT_FALSE(geometry.ok()) << to_string(*geometry);
  EXPECT_EQ(geometry.error().code, ErrorCode::illegal_parameter);
  for (const auto& piece : c.says) EXPECT_THAT(geometry.error().message, HasSubstr(piece));
}

INSTANTIATE_TEST_SUITE_P(Geometry, Refused, ::testing::ValuesIn(kRefusedPresets),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(CheckedGeometry, AcceptsTheLimits) {
  const GridAxis widest = {16384, 128, -16384, 128 * 3, 0, 0};  // active on [-16384, 32768)
  const GridAxis margins = {1, 1, 16384, 1, 127, 0};
  for (const int32_t capacity : {1, 65535}) {
    const auto geometry = checked_geometry({widest, margins, capacity});
    ASSERT_TRUE(geometry.ok()) << geometry.error().message;
    EXPECT_EQ(*geometry, (Geometry{widest, margins, capacity}));
  }
}

TEST(CheckedGeometry, RefusesEachFieldOfEachAxis) {
  struct Case {
    std::function<void(GridAxis&)> spoil;
    std::string field;
    std::string value;
    std::string range;
  };
  constexpr int32_t kMin = std::numeric_limits<int32_t>::min();
  constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
  const Case cases[] = {
      {[](GridAxis& a) { a.size = 0; }, "sensor size", "0", "1 to 16384"},
      {[](GridAxis& a) { a.size = 16385; }, "sensor size", "16385", "1 to 16384"},
      {[](GridAxis& a) { a.cell = 0; }, "cell", "0", "1 to 128"},
      {[](GridAxis& a) { a.cell = kMin; }, "cell", "-2147483648", "1 to 128"},
      {[](GridAxis& a) { a.cell = 129; }, "cell", "129", "1 to 128"},
      {[](GridAxis& a) { a.grid = 0; }, "grid", "0", "1 to 49152"},
      {[](GridAxis& a) { a.grid = kMax; }, "grid", "2147483647", "1 to 49152"},
      {[](GridAxis& a) { a.margin_lo = -1; }, "margin_lo", "-1", "0 to 128"},
      {[](GridAxis& a) { a.margin_lo = kMax; }, "margin_lo", "2147483647", "0 to 128"},
      {[](GridAxis& a) { a.margin_hi = -1; }, "margin_hi", "-1", "0 to 128"},
      {[](GridAxis& a) { a.margin_hi = kMax; }, "margin_hi", "2147483647", "0 to 128"},
      {[](GridAxis& a) { a.margin_hi = 119; }, "receptive field", "129", "1 to 128"},
      {[](GridAxis& a) { a.origin = -16385; }, "origin", "-16385", "-16384 to 16483"},
      {[](GridAxis& a) { a.origin = 16484; }, "origin", "16484", "-16384 to 16483"},
      {[](GridAxis& a) { a.grid = 1832; }, "end of the last active region", "16488", "-16383 to 16484"},
  };
  const GridAxis good = {100, 9, 0, 12, 1, 1};
  for (const Case& c : cases) {
    for (const bool spoil_x : {true, false}) {
      Geometry geometry = {good, good, 5};
      c.spoil(spoil_x ? geometry.x : geometry.y);
      const auto checked = checked_geometry(geometry);
      ASSERT_FALSE(checked.ok()) << to_string(geometry);
      EXPECT_EQ(checked.error().code, ErrorCode::illegal_parameter);
      EXPECT_THAT(checked.error().message,
                  AllOf(HasSubstr(c.field), HasSubstr(spoil_x ? " x is" : " y is"),
                        HasSubstr("is " + c.value), HasSubstr("legal is " + c.range)));
    }
  }
}

TEST(CheckedGeometry, RefusesTheCapacity) {
  const GridAxis good = {100, 9, 0, 12, 1, 1};
  for (const int32_t capacity : {0, -1, 65536}) {
    const auto checked = checked_geometry({good, good, capacity});
    ASSERT_FALSE(checked.ok());
    EXPECT_THAT(checked.error().message, AllOf(HasSubstr("capacity is " + std::to_string(capacity)),
                                               HasSubstr("legal is 1 to 65535")));
  }
}

TEST(Preset, NamesRoundTrip) {
  for (const auto preset :
       {Preset::paper, Preset::light, Preset::event_driven, Preset::event_driven_flex, Preset::explicit_}) {
    const auto back = preset_from_name(preset_name(preset));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(*back, preset);
  }
  const auto unknown = preset_from_name("Paper");
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(
      unknown.error().message,
      AllOf(HasSubstr("'Paper'"), HasSubstr("paper, light, event_driven, event_driven_flex, explicit")));
}

TEST(Geometry, TextNamesAllThirteenIntegers) {
  const Geometry g = {{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}, 13};
  EXPECT_EQ(to_string(g),
            "sensor 1x7 cell 2x8 origin 3,9 grid 4x10 margin_lo 5,11 margin_hi 6,12 capacity 13");
}

}  // namespace
}  // namespace scarf
