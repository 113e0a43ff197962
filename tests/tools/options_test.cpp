#include "tools/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/request.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;

constexpr SensorSize kSensor{640, 480};

// The options of a command line, which the parser must accept.
StreamRequest parsed(const std::string& line) {
  CLI::App app;
  StreamRequest options;
  add_settings(app, stream_settings(options));
  app.parse("recording " + line);
  return options;
}

bool refused_by_parser(const std::string& line) {
  CLI::App app;
  StreamRequest options;
  add_settings(app, stream_settings(options));
  try {
    app.parse("recording " + line);
  } catch (const CLI::ParseError&) {
    return true;
  }
  return false;
}

std::string grid_error(const std::string& line) {
  const auto grid = grid_on(parsed(line), kSensor);
  if (grid) return "no error";
  EXPECT_EQ(grid.error().code, ErrorCode::illegal_parameter);
  return in_options(grid.error().message);
}

const std::string kExplicit =
    "--preset explicit --cell 18x16 --origin -3,-4 --grid 36x30 --margin-lo 4,5 --margin-hi 6,7 --capacity "
    "100";

TEST(StreamSettings, DefaultsAreThePaper) {
  const StreamRequest options = parsed("");
  EXPECT_EQ(options.file, "recording");
  EXPECT_EQ(*grid_on(options, kSensor), *make_geometry(Preset::paper, kSensor));
  EXPECT_EQ(options.accumulation, 0.3);
  EXPECT_FALSE(options.read.sensor.has_value());
  EXPECT_FALSE(options.cpu);
  EXPECT_EQ(BatchSizes(options.batches).next(), kDefaultBatch);
}

TEST(StreamSettings, PresetsTakeTheirParameters) {
  const StreamRequest options = parsed(
      "--preset event_driven_flex --cell 12 --ratio 1.5 --alpha 3 --accumulation 0.25 --geometry 320x240");
  EXPECT_EQ(*grid_on(options, kSensor),
            *make_geometry(Preset::event_driven_flex, kSensor, {.cell = 12, .ratio = 1.5, .alpha = 3.0}));
  EXPECT_EQ(options.accumulation, 0.25);
  EXPECT_EQ(options.read.sensor, (SensorSize{320, 240}));
}

TEST(StreamSettings, ExplicitTakesAllThirteenIntegers) {
  const Geometry expected{{640, 18, -3, 36, 4, 6}, {480, 16, -4, 30, 5, 7}, 100};
  EXPECT_EQ(*grid_on(parsed(kExplicit), kSensor), expected);
}

TEST(StreamSettings, ExplicitNamesWhatIsMissing) {
  for (const std::string option :
       {"--cell", "--origin", "--grid", "--margin-lo", "--margin-hi", "--capacity"}) {
    std::string line = kExplicit;
    const size_t begin = line.find(option + " ");
    const size_t value = begin + option.size() + 1;
    line.erase(begin, std::min(line.find(' ', value), line.size()) - begin);
    EXPECT_THAT(grid_error(line), HasSubstr("needs " + option)) << line;
  }
}

TEST(StreamSettings, ExplicitRefusesRatioAndAlpha) {
  EXPECT_THAT(grid_error(kExplicit + " --ratio 1"), HasSubstr("--ratio"));
  EXPECT_THAT(grid_error(kExplicit + " --alpha 1"), HasSubstr("--alpha"));
}

TEST(StreamSettings, OtherPresetsRefuseWhatExplicitTakes) {
  for (const std::string given :
       {"--origin 0,0", "--grid 3x3", "--margin-lo 1,1", "--margin-hi 1,1", "--capacity 5"}) {
    EXPECT_THAT(grid_error(given), HasSubstr(given.substr(0, given.find(' ')))) << given;
  }
  EXPECT_THAT(grid_error("--cell 9x9"), HasSubstr("--cell"));
  EXPECT_THAT(grid_error("--cell nine"), HasSubstr("--cell"));
  EXPECT_THAT(grid_error("--preset light --ratio 1"), HasSubstr("ratio"));
}

TEST(StreamSettings, TheParserRefusesIllegalValues) {
  for (const char* line :
       {"--geometry 640", "--geometry 640x", "--geometry 0x480", "--geometry 640x16385", "--geometry 640X480",
        "--preset unknown", "--batch 0", "--ratio wide", "--origin 3x3", "--grid 3,3", "--capacity 1.5",
        "--cpu --device 0", "--cpu --require-gpu", "--unknown", "another"}) {
    EXPECT_TRUE(refused_by_parser(line)) << line;
  }
}

TEST(StreamSettings, TheCpuIsTheReference) {
  const StreamRequest options = parsed("--cpu --accumulation 0.5");
  const auto implementation = make_implementation(options, {64, 48});
  ASSERT_TRUE(implementation.ok());
  EXPECT_EQ(implementation->name, "CPU reference");
  const Event event{.t = 0, .x = 3, .y = 4, .p = 1};
  ASSERT_TRUE(implementation->representation->push(std::span(&event, 1)).ok());
  EXPECT_EQ(implementation->representation->u8_image().wait()->at(3, 4), 128);
}

}  // namespace
}  // namespace scarf::tools
