// Every real recording (SCARF_DATA_DIR) through the program: what is known of it, and a picture.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "scarf/io/recordings.h"
#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Known {
  const char* path;
  const char* options;
  uint64_t events;
  int64_t on;      // -1: not known
  double seconds;  // from the first to the last event, as precisely as they are known
  double precision;
  const char* digest;
};

constexpr Known kKnown[] = {
    {"raw/hd_evt3_driving.raw", "", 219'596, 115'532, 0.0088, 1e-4,
     "9bba5ca48301878102200069a89413a3240eaae3ff599d217f1c1a84d13fe7ba"},
    {"raw/vga_evt2_sparks.raw", "", 521'252, 185'861, 0.096, 1e-3,
     "58773c06cd3098d13e0f2781e1134449d2f01ed498d4975aabc2c4e5ec81d44b"},
    {"es/dvs.es", "", 473'225, 270'001, 0.999, 1e-3,
     "0e8b5a168fd6f024136faf24807558bec5ed65ebd3300b2712c1e2944fd69f4c"},
    {"ros/evt3_events.bag", "", 343'474, 125'183, 2.08, 1e-2, ""},
    {"ros/evt3_events.db3", "", 343'474, 125'183, 2.08, 1e-2, ""},
    {"ros/hd_evt3_trigger.db3", "", 82'469, -1, 1.25, 1e-2, ""},
    {"ros/libcaer_cmp_events.mcap", "", 571'266, 211'043, 1.0, 1e-1, ""},
    {"ros/libcaer_rollover.db3", "", 334'331, -1, 2.0, 1e-1, ""},
    {"aedat/davis346_newtons_cradle.aedat4", "", 319'512, -1, 0.51, 1e-2, ""},
    {"aedat/davis346_short.aedat4", "", 117'667, -1, 0.13, 1e-2, ""},
    {"aedat/davis240_boxes_aedat2.aedat", "", 162'771, 82'944, 2.072651, 1e-6,
     "417ddf2f4147444a7fb285d0064f684d4807e107c01663819b4976834c6eea8e"},
    {"yarp/bouncing_ball", "--geometry 304x240", 32'532, -1, 15.9, 1e-1, ""},
    {"frames/camerashake.zip", "", 7'213'245, -1, 12.1, 1e-1, ""},
    {"frames/slider_depth_50k.zip", "", 50'000, -1, 0.17, 1e-2, ""},
    {"stereo/box1.txt", "--columns txypc_ --time-unit us --stream 0 --geometry 240x180", 40'058, -1, 4.9,
     0.25, ""},
    {"stereo/box1.txt", "--columns txypc_ --time-unit us --stream 1 --geometry 240x180", 97'179 - 40'058, -1,
     4.9, 0.1, ""},
    {"misc/ncars.dat", "--geometry 100x100", 2'009, 1'350, 0.099952, 1e-6,
     "ad3600a8858f0dd69ff8452b20dff06d65edf147a5373f72066b84f262abda82"},
    {"misc/nmnist.bin", "--format nmnist --geometry 34x34", 4'325, -1, 0.31, 1e-2, ""},
    {"misc/pendulum_stereo.npz", "--stream left --geometry 128x128", 141'252, -1, 13.69, 1e-2, ""},
    {"misc/pendulum_stereo.npz", "--stream right --geometry 128x128", 261'307, -1, 13.69, 1e-2, ""},
};

void PrintTo(const Known& known, std::ostream* out) {
  *out << known.path << " " << known.options;
}

class RealRecordings : public Program {
 protected:
  void SetUp() override {
    const char* const folder = std::getenv("SCARF_DATA_DIR");
    if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
    for (const FormatInfo& format : formats()) {
      if (!format.missing.empty()) GTEST_SKIP() << format.name << " needs " << format.missing;
    }
    data_ = folder;
  }

  std::string data_;
};

class KnownAnswers : public RealRecordings, public testing::WithParamInterface<Known> {};

TEST_P(KnownAnswers, AreGivenAndThereIsAPicture) {
  const Known& known = GetParam();
  const std::string recording = text(data_, "/", known.path, " ", known.options);
  const Outcome outcome = run("info --digest --json " + recording);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json info = Json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(info["events"].get<uint64_t>() + info["outside"].get<uint64_t>(), known.events);
  if (known.on >= 0) {
    EXPECT_EQ(info["on"], known.on);
  }
  EXPECT_NEAR(info["duration_us"].get<double>() * 1e-6, known.seconds, known.precision);
  if (*known.digest != '\0') {
    EXPECT_EQ(info["digest"], known.digest);
  }
  for (const char* none : {"back_steps", "unknown_words", "truncated_bytes", "damages", "gaps"}) {
    EXPECT_EQ(info[none], 0) << none;
  }

  const Outcome rendered = run(text("render ", recording, " -o ", path("end.png")));
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  const cv::Mat picture = cv::imread(path("end.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.type(), CV_8UC1);
  EXPECT_EQ(text(picture.cols, "x", picture.rows), info["sensor"]);
  EXPECT_GT(cv::countNonZero(picture), 0);
}

INSTANTIATE_TEST_SUITE_P(Real, KnownAnswers, testing::ValuesIn(kKnown));

TEST_F(RealRecordings, AreAllKnown) {
  std::set<std::string> known = {"README.md"};
  for (const Known& one : kKnown) known.insert(one.path);
  for (const auto& entry : fs::recursive_directory_iterator(data_)) {
    const fs::path relative = entry.path().lexically_relative(data_);
    const bool in_recording = known.contains(relative.parent_path().generic_string());
    if (entry.is_regular_file() && !in_recording) {
      EXPECT_TRUE(known.contains(relative.generic_string())) << relative;
    }
  }
}

}  // namespace
}  // namespace scarf::tools
