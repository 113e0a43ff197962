// scarf info of several recordings and of folders.
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

class Info : public Program {
 protected:
  void write(const std::string& name, const std::string& content) {
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream(path(name)) << content;
  }

  // Two recordings, one of them in a folder below, a broken one, and what is no recording.
  std::string folder() {
    write("f/a.txt", "64 48\n0.1 3 4 1\n");
    write("f/below/b.txt", "32 24\n0.1 3 4 1\n0.2 3 5 0\n");
    write("f/notes.md", "Once upon a time\n");
    return path("f");
  }
};

TEST_F(Info, OfOneRecordingIsOneBlockAndOneObject) {
  folder();
  EXPECT_THAT(run("info " + path("f/a.txt")).out, testing::StartsWith("format:            text\nsensor:"));
  const Json json = Json::parse(run("info --json --digest " + path("f/a.txt")).out);
  EXPECT_EQ(json.at("schema"), 1);
  EXPECT_EQ(json.at("format"), "text");
  EXPECT_EQ(json.at("events"), 1);
  EXPECT_EQ(json.at("digest").get<std::string>().size(), 64u);
  EXPECT_FALSE(json.contains("recordings"));
}

TEST_F(Info, OfSeveralTellsOfEach) {
  folder();
  const std::string files = path("f/a.txt") + " " + path("f/below/b.txt");
  const Outcome outcome = run("info --digest " + files);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              testing::StartsWith("file:              " + path("f/a.txt") + "\nformat:            text\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n\nfile:              " + path("f/below/b.txt") + "\n"));
  const Json json = Json::parse(run("info --json " + files).out);
  EXPECT_EQ(json.at("schema"), 1);
  ASSERT_EQ(json.at("recordings").size(), 2u);
  EXPECT_EQ(json.at("recordings")[0].at("file"), path("f/a.txt"));
  EXPECT_EQ(json.at("recordings")[1].at("sensor"), "32x24");
  EXPECT_EQ(json.at("recordings")[1].at("events"), 2);
  EXPECT_TRUE(json.at("skipped").empty());
}

TEST_F(Info, OfAFolderLeavesOutWhatIsNoRecording) {
  const Outcome outcome = run("info --json " + folder());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  ASSERT_EQ(json.at("recordings").size(), 2u);
  EXPECT_EQ(json.at("recordings")[0].at("file"), path("f/a.txt"));
  EXPECT_EQ(json.at("recordings")[1].at("file"), path("f/below/b.txt"));
  EXPECT_EQ(json.at("skipped"), Json::array({path("f/notes.md")}));
  EXPECT_THAT(run("info " + path("f")).out,
              HasSubstr("\n\nskipped, as no recordings:\n  " + path("f/notes.md")));
}

TEST_F(Info, GoesOnBehindABrokenRecording) {
  folder();
  write("f/b_broken.raw", "% evt 9.9\n% end\n");
  for (const std::string& what :
       {path("f"), path("f/a.txt") + " " + path("f/b_broken.raw") + " " + path("f/below/b.txt")}) {
    const Outcome outcome = run("info " + what);
    EXPECT_EQ(outcome.exit_code, 1) << what;
    EXPECT_THAT(outcome.err, HasSubstr("1 of 3 recordings cannot be read"));
    EXPECT_THAT(outcome.err, HasSubstr("b_broken.raw"));
    EXPECT_THAT(outcome.out, HasSubstr("below/b.txt\nformat:            text\n"));
    EXPECT_THAT(outcome.out, HasSubstr("b_broken.raw\nerror:             "));
    const Outcome as_json = run("info --json " + what);
    EXPECT_EQ(as_json.exit_code, 1) << what;
    const Json json = Json::parse(as_json.out);
    EXPECT_EQ(json.at("recordings").size(), 3u);
    EXPECT_THAT(json.at("recordings")[1].at("error").get<std::string>(), HasSubstr("9.9"));
  }
  // What is named must be a recording.
  const Outcome named = run("info " + path("f/a.txt") + " " + path("f/notes.md") + " " + path("f/missing"));
  EXPECT_EQ(named.exit_code, 1);
  EXPECT_THAT(named.err, HasSubstr("2 of 3"));
  EXPECT_THAT(named.out, Not(HasSubstr("skipped, as no")));
}

TEST_F(Info, OfNothingIsAnError) {
  fs::create_directory(path("empty"));
  EXPECT_EQ(run("info " + path("empty")).exit_code, 1);
  EXPECT_EQ(run("info - - </dev/null").exit_code, 2);
}

}  // namespace
}  // namespace scarf::tools
