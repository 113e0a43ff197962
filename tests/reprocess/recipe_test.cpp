#include "reprocess/recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/temporary_folder.h"

namespace scarf::reprocess {

using namespace tools;  // fixtures of the tests of the program
namespace {

using testing::HasSubstr;

class RecipeFile : public testing::Test {
 protected:
  Result<Recipe> read(const std::string& content) {
    write_text(folder_.path("recipe.toml"), content);
    return read_recipe(folder_.path("recipe.toml"));
  }
  std::string error_of(const std::string& content) {
    const auto recipe = read(content);
    if (recipe) return "no error";
    EXPECT_EQ(recipe.error().code, ErrorCode::illegal_parameter);
    return recipe.error().message;
  }

  const TemporaryFolder folder_;
};

TEST_F(RecipeFile, LaysRulesOverSettingsInTheirOrder) {
  const auto recipe = read(R"(
representation = "eros"
kernel = 7
rate = 30
output = [".frames/", ".png"]
filter = ["support:range=1", "refractory:period=1ms"]
[[input]]
match = "*.txt"
geometry = "64x48"
[[input]]
match = "special/*.txt"
geometry = "32x32"
every = 100
)");
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  const SettingWords plain = recipe->for_recording("a/b.raw");
  EXPECT_EQ(plain.at("kernel"), std::vector<std::string>{"7"});
  EXPECT_FALSE(plain.contains("geometry"));
  EXPECT_EQ(recipe->for_recording("a/b.txt").at("geometry").front(), "64x48");
  const SettingWords special = recipe->for_recording("special/deep/b.txt");  // * is also for /
  EXPECT_EQ(special.at("geometry").front(), "32x32");
  EXPECT_TRUE(special.contains("every"));
  EXPECT_FALSE(special.contains("rate"));  // one instant replaces the other

  const auto options = parse_settings(special);
  ASSERT_TRUE(options.ok()) << options.error().message;
  EXPECT_EQ(options->frames.every, 100u);
  EXPECT_EQ(options->stream.filters.size(), 2u);
  EXPECT_EQ(options->stream.read.sensor, (SensorSize{32, 32}));
  EXPECT_EQ(options->outputs.size(), 2u);
}

TEST_F(RecipeFile, IsOnTopOfTheDefault) {
  EXPECT_EQ(read("")->settings, default_recipe().settings);
}

TEST_F(RecipeFile, MistakesNameTheLineAndTheSetting) {
  EXPECT_THAT(error_of("representation = \n"), HasSubstr("line 1"));
  EXPECT_THAT(error_of("representatoin = \"eros\"\n"), HasSubstr("representatoin"));
  EXPECT_THAT(error_of("representation = \"nothing\"\n"), HasSubstr("nothing"));
  EXPECT_THAT(error_of("output = \".jpg\"\n"), HasSubstr(".jpg"));
  EXPECT_THAT(error_of("output = \"../a.png\"\n"), HasSubstr("../a.png"));
  EXPECT_THAT(error_of("output = \".tmp/\"\n"), HasSubstr("taken"));
  EXPECT_THAT(error_of("rate = 30\n"), HasSubstr("output"));  // the default output is one picture
  EXPECT_THAT(error_of("output = \".frames/\"\nrate = 30\nevery = 5\n"), HasSubstr("rate"));
  EXPECT_THAT(error_of("pixels = \"float\"\n"), HasSubstr(".npy"));
  EXPECT_THAT(error_of("output = \".npy\"\nencoding = \"tore\"\n"), HasSubstr(".h5"));
  EXPECT_THAT(error_of("output = \".h5\"\nencoding = \"nothing\"\n"), HasSubstr("nothing"));
  EXPECT_THAT(error_of("output = \".h5\"\nencoding = \"tore\"\npixels = \"float\"\n"), HasSubstr("pixels"));
  EXPECT_THAT(error_of("sparse = \".txt\"\n"), HasSubstr(".npz"));
  EXPECT_THAT(error_of("representation = \"aae\"\nsparse = \".npz\"\n"), HasSubstr("aae"));
  EXPECT_THAT(error_of("[reading]\ngeometry = \"1x1\"\n"), HasSubstr("reading"));
  EXPECT_THAT(error_of("\n[[input]]\ngeometry = \"1x1\"\n"), HasSubstr("match"));
  EXPECT_THAT(error_of("\n[[input]]\nmatch = \"*\"\ngeometry = \"x\"\n"), HasSubstr("line 2"));
  EXPECT_EQ(read_recipe(folder_.path("missing.toml")).error().code, ErrorCode::io);
}

TEST_F(RecipeFile, IsARegularFileOfText) {
  EXPECT_THAT(error_of(std::string("[\0\0", 3)), HasSubstr("line 1"));
  EXPECT_THAT(error_of("[%"), HasSubstr("line 1"));
  // Outside strings and comments TOML is ASCII, and everywhere UTF-8.
  EXPECT_THAT(error_of("\n\xEF\xBB\xBE"), HasSubstr("line 2"));
  EXPECT_THAT(error_of("rate = 30 # \xEF\xB8\x8F\n\xC3\xA9 = 1"), HasSubstr("line 2"));
  for (const char* bad : {"\xFF", "\xC3", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC0\xAF"}) {
    EXPECT_THAT(error_of(std::string("# ") + bad), HasSubstr("UTF-8"));
  }
  EXPECT_THAT(error_of("representation = \"\xC3\xA9\xF0\x9F\x98\x80\""),
              HasSubstr("\xC3\xA9\xF0\x9F\x98\x80"));
}

TEST_F(RecipeFile, SideFilesStandBesideTheRecording) {
  EXPECT_EQ(side_file("{stem}.times", "/a/b.raw"), "/a/b.times");
  EXPECT_EQ(side_file("labels/{name}.csv", "/a/b.raw"), "/a/labels/b.raw.csv");
  EXPECT_EQ(side_file("{path}.times", "/a/b.raw"), "/a/b.raw.times");
  EXPECT_EQ(side_file("images.txt", folder_.path("")), folder_.path("images.txt"));
}

TEST(Recipes, EmptyValuesAreErrorsOfEverySetting) {
  Options options;
  const Settings all = settings_of(options);
  size_t settings = 0;
  for (const Setting& setting : all.all()) {
    const std::string& name = setting.name;
    ++settings;
    for (const std::string value : {"", " ", "\t"}) {
      SettingWords changed = default_recipe().settings;
      changed[name] = {value};
      const auto parsed = parse_settings(changed);
      ASSERT_FALSE(parsed.ok()) << name;
      EXPECT_EQ(parsed.error().code, ErrorCode::illegal_parameter) << name;
      EXPECT_EQ(parsed.error().message, name + " is empty; give it a value, or leave it out");
    }
  }
  EXPECT_GE(settings, 40u);
}

}  // namespace
}  // namespace scarf::reprocess
