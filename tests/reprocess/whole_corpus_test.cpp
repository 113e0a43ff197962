// scarf reprocess over all real recordings (SCARF_DATA_DIR), with a corrupt and an unreadable file among
// them.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "scarf/io/recordings.h"
#include "tests/reprocess/reprocess_runs.h"

namespace scarf::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// What the files do not say themselves.
constexpr const char* kRecipe = R"(output = ".png"

[[input]]
match = "ncars.dat"
geometry = "100x100"

[[input]]
match = "nmnist.bin"
format = "nmnist"
geometry = "34x34"

[[input]]
match = "pendulum_stereo.npz"
stream = "left"
geometry = "128x128"

[[input]]
match = "box1.txt"
columns = "txypc_"
time-unit = "us"
stream = "0"
geometry = "240x180"

[[input]]
match = "bouncing_ball"
geometry = "304x240"
)";

struct Known {
  const char* path;
  uint64_t events;
};

constexpr Known kRecordings[] = {
    {"aedat/davis240_boxes_aedat2.aedat", 162'771},
    {"aedat/davis346_newtons_cradle.aedat4", 319'512},
    {"aedat/davis346_short.aedat4", 117'667},
    {"es/dvs.es", 473'225},
    {"frames/camerashake.zip", 7'213'245},
    {"frames/slider_depth_50k.zip", 50'000},
    {"misc/ncars.dat", 2'009},
    {"misc/nmnist.bin", 4'325},
    {"misc/pendulum_stereo.npz", 141'252},
    {"raw/hd_evt3_driving.raw", 219'596},
    {"raw/vga_evt2_sparks.raw", 521'252},
    {"ros/evt3_events.bag", 343'474},
    {"ros/evt3_events.db3", 343'474},
    {"ros/hd_evt3_trigger.db3", 82'469},
    {"ros/libcaer_cmp_events.mcap", 571'266},
    {"ros/libcaer_rollover.db3", 334'331},
    {"stereo/box1.txt", 40'058},
    {"yarp/bouncing_ball", 32'532},
};

class WholeCorpus : public ReprocessTest {
 protected:
  void SetUp() override {
    const char* const data = std::getenv("SCARF_DATA_DIR");
    if (!data) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
    for (const FormatInfo& format : formats()) {
      if (!format.missing.empty()) GTEST_SKIP() << format.name << " needs " << format.missing;
    }
    fs::create_directories(path("in/added"));
    for (const auto& entry : fs::directory_iterator(data)) {
      fs::create_symlink(entry.path(), path("in/" + entry.path().filename().string()));
    }
    const std::string whole = content_of(text(data, "/frames/slider_depth_50k.zip"));
    write_text(path("in/added/corrupt.zip"), whole.substr(0, whole.size() / 2));
    // Opens, and fails to be read at its beginning, for every user.
    fs::create_symlink("/proc/self/mem", path("in/added/unreadable.raw"));
    write_text(path("recipe.toml"), kRecipe);
  }

  std::string arguments(const std::string& out) const {
    return in_to(out, text("--resume --keep-going --recipe ", path("recipe.toml")));
  }

  void expect_summary(const Outcome& outcome, const std::string& out) const {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
    EXPECT_TRUE(unfinished(out).empty());
    const Json summary = json_in(path(out + "/summary.json"));
    std::map<std::string, uint64_t> good;
    std::map<std::string, std::string> bad;
    for (const Json& one : summary["recordings"]) {
      const std::string name = one["input"];
      const std::string what = one["outcome"];
      if (what == "done" || what == "finished before") {
        good[name] = one["events"];
      } else {
        bad[name] = text(what, ": ", one["message"].get<std::string>());
      }
    }
    for (const Known& known : kRecordings) {
      EXPECT_EQ(good[known.path], known.events) << known.path << " " << bad[known.path];
      EXPECT_TRUE(fs::exists(path(text(out, "/", known.path, ".png")))) << known.path;
      bad.erase(known.path);
    }
    EXPECT_EQ(good.size(), std::size(kRecordings));
    EXPECT_THAT(bad["added/corrupt.zip"], AllOf(StartsWith("failed: "), HasSubstr("zip archive")));
    EXPECT_THAT(bad["added/unreadable.raw"], AllOf(StartsWith("failed: "), HasSubstr("cannot")));
    EXPECT_EQ(bad["README.md"], "skipped: not a recording");
    EXPECT_EQ(bad.size(), 3u);
  }
};

TEST_F(WholeCorpus, EndsWithTheExpectedSummaryAlsoWhenKilledTwentyTimes) {
  const auto start = std::chrono::steady_clock::now();
  expect_summary(run(arguments("whole")), "whole");
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  // Long enough to finish something, short enough not to finish all before the last kill.
  const auto longest_ms = std::max<uint64_t>(100, static_cast<uint64_t>(time.count() / 12));
  ASSERT_NO_FATAL_FAILURE(kill_twenty_times("out", arguments("out"), longest_ms));
  expect_summary(run(arguments("out")), "out");
  EXPECT_EQ(records("out"), records("whole"));
}

}  // namespace
}  // namespace scarf::tools
