// What the program does with recordings that give no event, and with those whose time jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "scarf/device/stream.h"
#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kOutside = "64 48\n0.1 64 1 1\n0.2 70 2 0\n0.3 99 3 1\n";

// Every job that makes something of a recording says that it made nothing, and leaves nothing.
TEST_F(Program, AJobThatGotNoEventHasFailed) {
  write_text(path("none.txt"), kOutside);
  write_text(path("empty.csv"), "%geometry:64,48\n");
  ASSERT_EQ(run("simulate " + path("no-triggers.raw") + " --duration 0.01 --sensor 64x48").exit_code, 0);
  fs::create_directory(path("made"));
  for (const std::string& job : std::vector<std::string>{
           "render --cpu RECORDING -o OUT/a.png", "render --cpu RECORDING -o OUT/a.npy",
           "render --cpu RECORDING -o OUT/a.mp4", "render --cpu RECORDING -o OUT/a.h5",
           "render --cpu RECORDING -o OUT/a.npy --sparse OUT/b.npz", "convert RECORDING OUT/a.raw",
           "convert RECORDING OUT/a.txt --check", "convert RECORDING OUT/a.npy",
           "cut RECORDING OUT/a.csv --from 0", "digest --cpu RECORDING",
           "digest --cpu RECORDING --dump OUT/dump", "verify RECORDING"}) {
    for (const char* recording : {"none.txt", "empty.csv"}) {
      std::string line = job;
      for (const auto& [word, name] :
           {std::pair{"RECORDING", path(recording)}, std::pair{"OUT", path("made")}}) {
        for (size_t at = 0; (at = line.find(word)) != line.npos;)
          line.replace(at, std::string_view(word).size(), name);
      }
      if (line.starts_with("verify") && !list_devices()) continue;
      SCOPED_TRACE(line);
      const Outcome outcome = run(line);
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_THAT(outcome.err,
                  AllOf(HasSubstr(recording), HasSubstr("not one event"), HasSubstr("--allow-empty")));
      EXPECT_EQ(outcome.out, "");
      EXPECT_TRUE(fs::is_empty(path("made")));
    }
  }
  EXPECT_THAT(run("digest --cpu " + path("none.txt")).err, HasSubstr("3 events outside the sensor"));
  const Outcome cut = run("cut " + recording(100) + " " + path("cut.raw") + " --from 900000000");
  EXPECT_EQ(cut.exit_code, 1);
  EXPECT_THAT(cut.err, AllOf(HasSubstr("none of the 100 events"), HasSubstr("--allow-empty")));
  EXPECT_FALSE(fs::exists(path("cut.raw")));
  const Outcome triggers = run("triggers " + path("no-triggers.raw") + " -o " + path("triggers.csv"));
  EXPECT_EQ(triggers.exit_code, 1);
  EXPECT_THAT(triggers.err, AllOf(HasSubstr("no trigger"), HasSubstr("--allow-empty")));
  EXPECT_FALSE(fs::exists(path("triggers.csv")));
}

TEST_F(Program, NoEventIsNoFailureWhereThatIsAllowed) {
  write_text(path("none.txt"), kOutside);
  ASSERT_EQ(run("simulate " + path("no-triggers.raw") + " --duration 0.01 --sensor 64x48").exit_code, 0);
  const std::string none = path("none.txt") + " --allow-empty";
  EXPECT_EQ(run("render --cpu " + none + " -o " + path("a.png")).exit_code, 0);
  EXPECT_TRUE(fs::exists(path("a.png")));
  EXPECT_EQ(run("convert " + path("none.txt") + " " + path("a.raw") + " --allow-empty").exit_code, 0);
  EXPECT_THAT(run("info " + path("a.raw")).out, HasSubstr("\nevents:            0\n"));
  EXPECT_EQ(run("cut " + recording(100) + " " + path("b.raw") + " --from 900000000 --allow-empty").exit_code,
            0);
  EXPECT_EQ(run("digest --cpu " + none).exit_code, 0);
  EXPECT_EQ(run("triggers " + path("no-triggers.raw") + " --allow-empty").out, "t_us,id,value\n");
  // Looking is no job.
  const Outcome info = run("info " + path("none.txt"));
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr("\nevents:            0\n"), HasSubstr("\noutside:           3\n")));
}

TEST_F(Program, InfoShowsJumpsAndOddPolarities) {
  write_text(path("jump.txt"),
             "64 48\nt x y p\n0.000010 1 2 1\n10.000010 1 2 0\n3010.000011 3 4 1\n3010.000012 5 6 2\n3110.5 "
             "3 4 0\n");
  const Outcome table = run("info " + path("jump.txt"));
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.out,
              AllOf(HasSubstr("\njumps:             2\n"), HasSubstr("\nlargest jump:      3000000001 us\n"),
                    HasSubstr("\njump from:         10000010 us\n"), HasSubstr("\nodd polarities:    1\n"),
                    HasSubstr("\nevents:            4\n")));
  const auto json = nlohmann::json::parse(run("info --json " + path("jump.txt")).out);
  EXPECT_EQ(json["jumps"], 2);
  EXPECT_EQ(json["largest_jump_us"], 3'000'000'001);
  EXPECT_EQ(json["largest_jump_from_us"], 10'000'010);
  EXPECT_EQ(json["undefined_polarities"], 1);
  const Outcome converted = run("convert " + path("jump.txt") + " " + path("jump.csv"));
  EXPECT_THAT(converted.out, HasSubstr("lost: 1 events whose polarity the format does not define\n"));
}

// A recording, a jump of so many seconds, and as much again.
std::string with_jump(int64_t seconds) {
  std::string lines = "%geometry:64,48\n";
  for (int64_t i = 0; i < 200; ++i) {
    const int64_t t = 1000 * i + (i < 100 ? 0 : seconds * 1'000'000);
    lines += text(i % 64, ",", i % 48, ",", i % 2, ",", t, "\n");
  }
  return lines;
}

TEST_F(Program, AJumpThatWouldFloodTheOutputEndsTheJobAndNothingIsWritten) {
  fs::create_directory(path("made"));
  write_text(path("jump.csv"), with_jump(3000));
  for (const char* output : {"made/frames", "made/a.npy", "made/a.mp4", "made/a.h5"}) {
    for (const char* machine : {" --cpu", ""}) {
      const Outcome outcome = run("render " + path("jump.csv") + machine + " -o " + path(output));
      EXPECT_EQ(outcome.exit_code, 1) << output;
      EXPECT_THAT(outcome.err, AllOf(HasSubstr("--max-frames"), HasSubstr("event 100 (t 3000100000 us)")))
          << output;
      if (fs::is_directory(path("made/frames"))) {
        EXPECT_TRUE(fs::is_empty(path("made/frames")));
        fs::remove(path("made/frames"));
      }
      EXPECT_TRUE(fs::is_empty(path("made"))) << output;
    }
  }
  // As many as the user wants, and a pause is none.
  write_text(path("pause.csv"), with_jump(20));
  EXPECT_THAT(run("render --cpu " + path("pause.csv") + " -o " + path("made/a.npy")).out,
              HasSubstr("rendered 605 frames"));
  EXPECT_EQ(run("render --cpu " + path("pause.csv") + " --max-frames 500 -o " + path("made/b.npy")).exit_code,
            1);
  EXPECT_EQ(run("render --cpu " + path("pause.csv") + " --max-frames 700 -o " + path("made/b.npy")).exit_code,
            0);
}

// Frames that have events are never too many.
TEST_F(Program, ALongRecordingIsNoFlood) {
  std::string lines = "%geometry:8,8\n";
  for (int64_t i = 0; i < 12'000; ++i) lines += text(i % 8, ",", i / 8 % 8, ",", i % 2, ",", 1000 * i, "\n");
  write_text(path("long.csv"), lines);
  EXPECT_THAT(run("render --cpu " + path("long.csv") + " --rate 1000 -o " + path("a.npy")).out,
              HasSubstr("rendered 11999 frames"));
}

}  // namespace
}  // namespace scarf::tools
