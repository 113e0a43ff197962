// Exit codes, one-line errors, what the program prints and writes.
#include "tests/tools/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/text.h"
#include "scarf/device/stream.h"
#include "scarf/digest/digest.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

TEST_F(Program, WithoutASubCommandShowsHelp) {
  const Outcome outcome = run("");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("render"));
  EXPECT_EQ(run("--help").exit_code, 0);
  EXPECT_EQ(run("render --help").exit_code, 0);
  EXPECT_THAT(run("--version").out, testing::MatchesRegex("scarf [0-9.]+\n"));
}

TEST_F(Program, BadUsageExitsWithTwo) {
  const std::string file = recording(100);
  write_text(path("prose"), "Once upon a time\nthere was a camera\n");
  fs::create_directory(path("folder"));
  for (const std::string& arguments :
       std::vector<std::string>{"unknown",
                                "--unknown",
                                "render",
                                "render " + file,
                                "render " + file + " -o",
                                "info",
                                "info --unknown x",
                                "compare a",
                                "digest " + file + " --cpu --cell 0",
                                "digest " + file + " --cpu --ratio -1",
                                "digest " + file + " --cpu --preset nothing",
                                "digest " + file + " --cpu --preset explicit",
                                "digest " + file + " --cpu --preset light --ratio 1",
                                "digest " + file + " --cpu --accumulation 0",
                                "digest " + file + " --cpu --batch none",
                                "digest " + file + " --cpu --geometry 0x0",
                                "render " + file + " --cpu -o " + path("o.jpg"),
                                "render " + file + " --cpu -o " + path("o") + " --rate 0",
                                "render " + file + " --cpu -o " + path("o") + " --every 0",
                                "render " + file + " --cpu -o " + path("o") + " --at start",
                                "render " + file + " --cpu -o " + path("o") + " --rate 5 --every 5",
                                "render " + file + " --cpu -o " + path("o.png") + " --rate 5",
                                "render " + file + " --cpu -o " + path("o.mp4") + " --at end",
                                "render " + file + " --cpu -o " + path("o") + " --video-fps 5",
                                "render " + file + " --cpu -o " + path("o.pgm") + " --compare-window 5",
                                "render " + file + " --cpu -o " + path("o") + " --every -1",
                                "render " + file + " --cpu -o " + path("o") + " --every 99999999999999999999",
                                "render " + file + " --cpu -o " + path("o") + " --rate nan",
                                "render " + file + " --cpu -o " + path("o") + " --rate 1e3",
                                "render " + file + " --cpu -o " + path("o") + " --max-frames 0",
                                "render " + file + " --cpu -o " + path("o.mp4") + " --video-fps nan",
                                "render " + file + " --cpu -o " + path("o.mp4") + " --video-fps 0",
                                "render " + file + " --cpu -o ''",
                                "render " + file + " --cpu -o /",
                                "render " + file + " --cpu -o " + path("prose"),
                                "simulate " + path("folder") + " --format text",
                                "simulate " + path("o.raw") + " --truth " + path("prose"),
                                "digest " + file + " --cpu --batch 0",
                                "digest " + file + " --cpu --geometry 64",
                                "digest " + file + " --cpu --device 0",
                                "verify " + file + " --max-events -1",
                                "simulate",
                                "simulate " + path("o.png"),
                                "simulate " + path("o.raw") + " --scene none",
                                "simulate " + path("o.raw") + " --format png",
                                "simulate " + path("o.raw") + " --sensor 0x0",
                                "simulate " + path("o.raw") + " --duration 0",
                                "simulate " + path("o.raw") + " --duration nan",
                                "simulate " + path("o.raw") + " --seed -1",
                                "simulate " + path("o.raw") + " --hot-pixels 1.5",
                                "simulate " + path("o.raw") + " --refractory -1",
                                "simulate " + path("o.raw") + " --truth " + path("o") + " --truth-rate 0",
                                "verify " + file + " --cpu"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.err;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_LT(outcome.err.size(), 300u) << outcome.err;
  }
  for (const char* output : {"o", "o.raw", "o.mp4", "o.png"})
    EXPECT_FALSE(fs::exists(path(output))) << output;
}

TEST_F(Program, BadInputExitsWithOne) {
  const std::string file = recording(100);
  write_text(path("empty"), "");
  write_text(path("prose"), "Once upon a time\nthere was a camera\n");
  write_text(path("no_sensor.txt"), "0.000001 3 4 1\n0.000002 3 5 0\n");
  write_text(path("escapes"), "\033[2J\007" + std::string(5000, 'x') + "\n");
  fs::create_directory(path("folder"));
  for (const std::string& arguments : std::vector<std::string>{
           "info " + path("missing"),
           "info " + path("folder"),
           "info " + path("empty"),
           "info - </dev/null",
           "info - <&-",
           "digest --cpu " + path("folder"),
           "verify " + path("folder"),
           "compare " + path("folder") + " " + path("folder"),
           "render " + file + " --cpu -o /proc/o.mp4",
           "render " + file + " --cpu -o " + path("o") + " --at-times " + path("folder"),
           "render " + file + " --cpu -o " + path("o") + " --at-times " + path("empty"),
           "render " + file + " --cpu -o " + path("o") + " --at-times " + path("escapes"),
           "simulate " + path("none/o.raw"),
           "simulate " + path("o.raw") + " --sensor 4096x16",
           "info " + path("prose"),
           "digest --cpu " + path("missing"),
           "digest --cpu " + path("no_sensor.txt"),
           "digest --cpu --geometry 32x32 " + file,
           "digest --cpu " + file + " --dump " + path("none/dump"),
           "digest " + file + " --device no-such-device",
           "compare " + path("missing") + " " + path("missing"),
           "compare " + path("prose") + " " + path("prose"),
           "render " + file + " --cpu -o " + path("none/o.png"),
           "render " + file + " --cpu -o " + path("none/o.mp4"),
           "render " + file + " --cpu -o " + path("o") + " --at-times " + path("missing"),
           "render " + file + " --cpu -o " + path("o") + " --at-times " + path("prose")}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments << "\n" << outcome.err;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
    EXPECT_LT(outcome.err.size(), 400u) << arguments;
    EXPECT_EQ(outcome.err.find('\033'), std::string::npos) << arguments;
    EXPECT_FALSE(fs::exists(path("o"))) << arguments;
    EXPECT_FALSE(fs::exists(path("o.raw"))) << arguments;
  }
  EXPECT_THAT(run("digest --cpu " + path("no_sensor.txt")).err, HasSubstr("--geometry"));
  EXPECT_EQ(run("digest --cpu --geometry 32x32 " + path("no_sensor.txt")).exit_code, 0);
}

TEST_F(Program, InfoCountsEverything) {
  write_text(path("some.txt"), "64 48\n0.000010 1 2 1\n0.000030 3 4 0\n0.000025 64 4 0\n0.000020 63 47 1\n");
  const Outcome outcome = run("info --digest " + path("some.txt"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto value = [&](const std::string& name) {
    const size_t begin = outcome.out.find("\n" + name + ":");
    if (begin == std::string::npos) return std::string("missing");
    std::istringstream line(outcome.out.substr(outcome.out.find(':', begin) + 1));
    std::string word;
    line >> word;
    return word;
  };
  EXPECT_THAT(outcome.out, StartsWith("format:            text\n"));
  EXPECT_EQ(value("sensor"), "64x48");
  EXPECT_EQ(value("events"), "3");
  EXPECT_EQ(value("on"), "2");
  EXPECT_EQ(value("off"), "1");
  EXPECT_EQ(value("first"), "10");
  EXPECT_EQ(value("last"), "20");
  EXPECT_EQ(value("duration"), "10");
  EXPECT_EQ(value("mean rate"), "300000");
  EXPECT_EQ(value("outside"), "1");
  EXPECT_EQ(value("back-steps"), "2");
  EXPECT_EQ(value("largest back-step"), "5");
  EventDigest digest;
  for (const Event& e : std::vector<Event>{{.t = 10, .x = 1, .y = 2, .p = 1},
                                           {.t = 30, .x = 3, .y = 4, .p = 0},
                                           {.t = 20, .x = 63, .y = 47, .p = 1}}) {
    digest.add(e);
  }
  EXPECT_THAT(outcome.out, testing::EndsWith("\nevents " + digest.hex() + "\n"));
}

TEST_F(Program, InfoNeedsNoSensor) {
  write_text(path("no_sensor.txt"), "0.000001 3 4 1\n0.000002 3 5 0\n");
  EXPECT_THAT(run("info " + path("no_sensor.txt")).out, HasSubstr("\nsensor:            unknown\n"));
}

TEST_F(Program, DigestsDoNotDependOnBatches) {
  const std::string file = recording();
  const auto scarf = *make_reference_scarf(*make_geometry(Preset::paper, kSensor));
  ASSERT_TRUE(scarf->push(events_).ok());
  EventDigest digest;
  for (const Event& e : events_) digest.add(e);
  const std::string expected = "state " + state_digest(*scarf->snapshot().wait()) + "\nimage " +
                               image_digest(*scarf->u8_image().wait()) + "\nevents " + digest.hex() + "\n";
  for (const char* batch : {"1", "777", "131072", "random", "random:9"}) {
    EXPECT_EQ(run("digest --cpu " + file + " --batch " + batch).out, expected) << batch;
  }
  EXPECT_EQ(run("digest --cpu - <" + file).out, expected);
}

TEST_F(Program, DumpsAreCompared) {
  const std::string file = recording();
  const std::string digest = "digest --cpu " + file + " --dump ";
  ASSERT_EQ(run(digest + path("a")).exit_code, 0);
  ASSERT_EQ(run(digest + path("b") + " --batch 99").exit_code, 0);
  ASSERT_EQ(run(digest + path("light") + " --preset light").exit_code, 0);
  const Outcome equal = run("compare " + path("a") + " " + path("b"));
  EXPECT_EQ(equal.exit_code, 0);
  EXPECT_THAT(equal.out, StartsWith("identical: 48 patches, "));

  std::string bytes = content_of(path("b"));
  bytes[60 + 8 + 3 * 14 + 6] ^= 1;  // patch 0, slot 3, lowest bit of t
  write_text(path("b"), bytes);
  const Outcome different = run("compare " + path("a") + " " + path("b"));
  EXPECT_EQ(different.exit_code, 1);
  EXPECT_THAT(different.out, StartsWith("different: patch 0 slot 3: (t "));

  const Outcome geometry = run("compare " + path("a") + " " + path("light"));
  EXPECT_EQ(geometry.exit_code, 1);
  EXPECT_THAT(geometry.out, HasSubstr("capacity 233"));
  EXPECT_THAT(geometry.out, HasSubstr("capacity 81"));
}

TEST_F(Program, RendersTheReferenceAtEachInstant) {
  const std::string file = recording();
  ASSERT_EQ(run("render --cpu " + file + " --rate 29.97 --batch 999 -o " + path("frames")).exit_code, 0);
  std::string csv = "index,t_us,events\n";
  int64_t frames = 0;
  for (int64_t i = 1;; ++i, ++frames) {
    const int64_t t = events_.front().t + i * 100'000'000 / 2997;
    const auto due = std::find_if(events_.begin(), events_.end(), [t](const Event& e) { return e.t >= t; });
    if (due == events_.end()) break;
    const auto n = static_cast<size_t>(due - events_.begin());
    csv += std::to_string(frames) + "," + std::to_string(t) + "," + std::to_string(n) + "\n";
    expect_picture(path(text("frames/frame_", std::setw(6), std::setfill('0'), frames, ".png")),
                   reference_picture(n));
  }
  EXPECT_GE(frames, 5);
  EXPECT_EQ(content_of(path("frames/frames.csv")), csv);
}

TEST_F(Program, RendersEveryNthEventAndGivenTimes) {
  const std::string file = recording(2500);
  ASSERT_EQ(run("render --cpu " + file + " --every 1000 --preset light -o " + path("every")).exit_code, 0);
  expect_picture(path("every/frame_000000.png"), reference_picture(1000, Preset::light));
  expect_picture(path("every/frame_000001.png"), reference_picture(2000, Preset::light));
  EXPECT_FALSE(fs::exists(path("every/frame_000002.png")));

  const int64_t t = events_[700].t;
  write_text(path("times"), "0\n" + std::to_string(t) + "\n9000000000\n");
  ASSERT_EQ(
      run("render --cpu " + file + " --at-times " + path("times") + " -o " + path("times_out")).exit_code, 0);
  const auto due = std::find_if(events_.begin(), events_.end(), [t](const Event& e) { return e.t >= t; });
  expect_picture(path("times_out/frame_000000.png"), reference_picture(0));
  expect_picture(path("times_out/frame_000001.png"),
                 reference_picture(static_cast<size_t>(due - events_.begin())));
  expect_picture(path("times_out/frame_000002.png"), reference_picture(2500));
}

// A file is replayed, standard input is not.
TEST_F(Program, RendersTheSameFromAFileAndFromAPipe) {
  const std::string simulated = path("stop.raw");
  ASSERT_EQ(run("simulate " + simulated + " --scene stop --sensor 64x48 --duration 0.3").exit_code, 0);
  for (const std::string when : {"--rate 1000", "--every 700", "--at end", "--rate 300 --preset light"}) {
    const Outcome file = run("render " + simulated + " --overwrite " + when + " -o " + path("file"));
    const Outcome pipe = run("render - --overwrite " + when + " -o " + path("pipe") + " <" + simulated);
    ASSERT_EQ(file.exit_code, 0) << file.err;
    ASSERT_EQ(pipe.exit_code, 0) << pipe.err;
    size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(path("pipe"))) {
      const std::string name = entry.path().filename().string();
      // The hidden list, too: it does not depend on the clock.
      EXPECT_EQ(content_of(path("file/" + name)), content_of(entry.path().string())) << when << " " << name;
      ++pictures;
    }
    EXPECT_GE(pictures, 3u);
    EXPECT_EQ(std::distance(fs::directory_iterator(path("file")), {}), pictures) << when;
  }
}

TEST_F(Program, RendersTheEnd) {
  const std::string file = recording(5000);
  ASSERT_EQ(run("render --cpu " + file + " -o " + path("end.png")).exit_code, 0);
  ASSERT_EQ(run("render --cpu " + file + " --at end -o " + path("end.pgm")).exit_code, 0);
  expect_picture(path("end.png"), reference_picture(5000));
  expect_picture(path("end.pgm"), reference_picture(5000));
}

TEST_F(Program, EventsOutsideTheSensorNeverMoveTime) {
  // At 1000 Hz the event at 5 ms would make frames due; it is outside, so only the one at 2 ms does.
  write_text(path("some.txt"), "64 48\n0.000000 99 2 1\n0.000500 1 2 1\n0.005000 64 4 0\n0.002000 3 4 1\n");
  ASSERT_EQ(run("render --cpu " + path("some.txt") + " --rate 1000 -o " + path("frames")).exit_code, 0);
  EXPECT_EQ(content_of(path("frames/frames.csv")), "index,t_us,events\n0,1500,1\n");
}

TEST_F(Program, OneCorruptTimeCannotFillTheDisk) {
  write_text(path("gap.txt"), "64 48\n0.000000 1 2 1\n90000.000000 3 4 1\n");
  const Outcome outcome = run("render --cpu " + path("gap.txt") + " -o " + path("frames"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--max-frames"));
  EXPECT_FALSE(fs::exists(path("frames/frame_000000.png")));
  write_text(path("gap.txt"), "64 48\n0.000000 1 2 1\n0.500000 3 4 1\n");
  EXPECT_EQ(run("render --cpu " + path("gap.txt") + " --max-frames 15 -o " + path("frames")).exit_code, 0);
  EXPECT_EQ(
      run("render --cpu --overwrite " + path("gap.txt") + " --max-frames 14 -o " + path("frames")).exit_code,
      1);
}

TEST_F(Program, RendersVideosAndComparisons) {
  const std::string file = recording();
  for (const char* name : {"v.mp4", "v.avi"}) {
    const Outcome outcome = run("render --cpu " + file + " --compare-window 20 -o " + path(name));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(fs::file_size(path(name)), 0u);
  }
  ASSERT_EQ(run("render --cpu " + file + " --compare-window -o " + path("both.png")).exit_code, 0);
  const cv::Mat both = cv::imread(path("both.png"), cv::IMREAD_UNCHANGED);
  const cv::Mat expected = reference_picture(events_.size());
  const cv::Mat left = both(cv::Rect(0, both.rows - 48, 64, 48));
  EXPECT_EQ(cv::countNonZero(left != expected), 0);
  const cv::Mat right = both(cv::Rect(both.cols - 64, both.rows - 48, 64, 48));
  for (const Event& e : events_) {
    if (e.t > events_.back().t - 33'000) {
      EXPECT_EQ(right.at<uint8_t>(e.y, e.x), 255);
    }
  }
}

TEST_F(Program, AFullDiskIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const std::string file = recording(100);
  EXPECT_EQ(run("digest --cpu " + file + " --dump /dev/full").exit_code, 1);
  fs::create_symlink("/dev/full", path("full.png"));
  EXPECT_EQ(run("render --cpu " + file + " -o " + path("full.png")).exit_code, 1);
  EXPECT_TRUE(fs::is_symlink(path("full.png")));
}

TEST_F(Program, LostOutputIsAnError) {
  const std::string file = recording(100);
  for (const std::string& arguments :
       std::vector<std::string>{"--version", "--help", "info " + file, "digest --cpu " + file,
                                "render --cpu --overwrite " + file + " -o " + path("o.png"),
                                "simulate - --format text --duration 0.01"}) {
    for (const std::string target : {"/dev/full", "&-"}) {
      if (target == "/dev/full" && !fs::exists(target)) continue;
      const Outcome outcome = run(arguments + " >" + target);
      EXPECT_EQ(outcome.exit_code, 1) << arguments << " >" << target;
      EXPECT_THAT(outcome.err, HasSubstr("standard output")) << arguments << " >" << target;
    }
  }
}

TEST_F(Program, SimulatesTheSameInEveryFormat) {
  const std::string options = " --scene shake --sensor 64x48 --duration 0.3 --seed 7 --hot-pixels 3 ";
  const auto events_in = [&](const std::string& file) {
    const std::string out = run("info --digest " + file).out;
    return out.substr(std::min(out.find("\nevents "), out.size()));
  };
  for (const std::string output : {"a.raw", "a.evt2 --format evt2", "a.txt", "a.csv", "again.raw"}) {
    ASSERT_EQ(run("simulate " + path(output) + options).exit_code, 0) << output;
  }
  EXPECT_EQ(content_of(path("a.raw")), content_of(path("again.raw")));
  const std::string events = events_in(path("a.raw"));
  EXPECT_THAT(events, StartsWith("\nevents "));
  for (const char* name : {"a.evt2", "a.txt", "a.csv"}) EXPECT_EQ(events_in(path(name)), events) << name;
  for (const auto& [name, format] : {std::pair{"a.raw", "evt3"}, {"a.evt2", "evt2"}, {"a.txt", "text"}}) {
    const std::string out = run("info " + path(name)).out;
    EXPECT_THAT(out, StartsWith(text("format:            ", format, "\n"))) << name;
    EXPECT_THAT(out, HasSubstr("\nsensor:            64x48\n")) << name;
  }

  ASSERT_EQ(run("simulate " + path("seed.raw") + options.substr(0, options.find("--seed"))).exit_code, 0);
  EXPECT_NE(events_in(path("seed.raw")), events);

  // To standard output the recording goes alone; what is told goes to standard error.
  const std::string to_stdout = "simulate - --format evt3" + options;
  const int status =
      std::system((SCARF_PROGRAM " " + to_stdout + " >" + path("out.raw") + " 2>" + path("told")).c_str());
  EXPECT_EQ(status, 0);
  EXPECT_EQ(content_of(path("out.raw")), content_of(path("a.raw")));
  EXPECT_THAT(content_of(path("told")), HasSubstr(" events, 0.3 s, "));
}

TEST_F(Program, SimulatesTheTruthBeside) {
  const std::string line =
      "simulate " + path("a.raw") + " --sensor 64x48 --duration 0.2 --truth " + path("truth");
  ASSERT_EQ(run(line + " --truth-rate 40").exit_code, 0);
  EXPECT_EQ(run(line + " --truth-rate 20").exit_code, 2);
  ASSERT_EQ(run(line + " --overwrite --truth-rate 20").exit_code, 0);  // replaces all of the earlier one
  EXPECT_EQ(content_of(path("truth/frames.csv")), "index,t_us\n0,0\n1,50000\n2,100000\n3,150000\n4,200000\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("truth")), fs::directory_iterator()),
            12);  // and the hidden list
  for (const char* name : {"frame_000004.png", "edges_000004.png"}) {
    const cv::Mat picture = cv::imread(path(text("truth/", name)), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(picture.type(), CV_8UC1) << name;
    EXPECT_EQ(picture.size(), cv::Size(64, 48)) << name;
    EXPECT_GT(cv::countNonZero(picture), 0) << name;
  }
}

TEST_F(Program, VerifiesTheDevice) {
  const auto devices = list_devices();
  if (!devices) GTEST_SKIP() << devices.error().message;
  const std::string file = recording();
  const Outcome outcome = run("verify " + file + " --batch random:3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("identical: 20000 events, "));
  EXPECT_THAT(run("verify " + file + " --batch 1000 --max-events 4500").out,
              StartsWith("identical: 4500 events, 5 batches, "));
  for (const std::string plan :
       {"--bands 3", "--bands 64 --chunk-events 1", "--submission-events 777",
        "--chunk-events 100 --submission-events 5000", "--placing chunked", "--placing appended --bands 2"}) {
    EXPECT_THAT(run("verify " + file + " --batch 6000 " + plan).out,
                StartsWith("identical: 20000 events, 4 "))
        << plan;
  }
  EXPECT_THAT(run("verify " + file + " --bands 65").err, HasSubstr("bands is 65, legal is 0 to 64"));
  EXPECT_EQ(run("digest " + file).out, run("digest --cpu " + file).out);
}

TEST_F(Program, DecodesCameraWordsOnTheDevice) {
  const std::string text_file = recording();
  for (const std::string format : {"evt2", "evt3"}) {
    const std::string raw = path(format + ".raw");
    ASSERT_EQ(run("simulate " + raw + " --format " + format + " --duration 0.05 --sensor 64x48").exit_code,
              0);
    const Outcome outcome = run("verify " + raw + " --batch 1000 --decode device");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("identical: "));
    for (const std::string where : {"device", "cpu"}) {
      EXPECT_EQ(
          run("render " + raw + " --overwrite -o " + path(where + ".pgm") + " --decode " + where).exit_code,
          0);
    }
    EXPECT_EQ(content_of(path("device.pgm")), content_of(path("cpu.pgm")));
    EXPECT_THAT(run("render " + raw + " -o " + path("frames") + " --decode device").err,
                HasSubstr("only the end"));
    EXPECT_THAT(run("render " + raw + " --overwrite -o " + path("cpu.pgm") + " --decode device --cpu").err,
                HasSubstr("--cpu"));
  }
  EXPECT_THAT(run("verify " + text_file + " --decode device").err, HasSubstr("EVT2 and EVT3"));
  EXPECT_THAT(run("verify - --decode device --geometry 64x48 <" + text_file).err, HasSubstr("give a file"));
}

TEST_F(Program, EveryRepresentationIsListedVerifiedAndShown) {
  const std::string file = recording(3000);
  const std::string list = run("representations").out;
  for (const RepresentationInfo& info : representations()) {
    EXPECT_THAT(list, HasSubstr(info.name + "  " + info.description + "\n"));
    for (const ParameterInfo& p : info.parameters)
      EXPECT_THAT(list, HasSubstr("--" + p.name + " " + p.value));
    const Outcome outcome = run("verify " + file + " --batch 700 --representation " + info.name);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr(info.exact ? "identical: 3000 events" : "within the bound: 3000 events"));
  }
  ASSERT_EQ(run("render --cpu " + file + " --representation all -o " + path("all.png")).exit_code, 0);
  const cv::Mat all = cv::imread(path("all.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(all.size(), cv::Size(3 * 64 + 2 * 8, 3 * (20 + 48) + 2 * 8));
  EXPECT_EQ(cv::countNonZero(all(cv::Rect(0, 20, 64, 48)) != reference_picture(3000)), 0);
}

TEST_F(Program, RepresentationsTakeTheirOwnParameters) {
  const std::string digest = "digest " + recording(3000) + " --representation eros ";
  const std::string with_defaults = run(digest + "--cpu").out;
  EXPECT_THAT(with_defaults, testing::MatchesRegex("state [0-9a-f]+\nimage [0-9a-f]+\nevents [0-9a-f]+\n"));
  EXPECT_EQ(run(digest + "--cpu --kernel 9 --decay 0.3").out, with_defaults);
  EXPECT_NE(run(digest + "--cpu --kernel 7").out, with_defaults);
  EXPECT_EQ(run(digest).out, with_defaults);  // on the device
  for (const char* wrong : {"--kernel 64", "--tau 1ms", "--preset light", "--accumulation 1"}) {
    EXPECT_EQ(run(digest + "--cpu " + wrong).exit_code, 2) << wrong;
  }
  EXPECT_THAT(run(digest + "--cpu --preset light").err, HasSubstr("--preset is used by scarf only"));
  EXPECT_EQ(run("digest " + recording(10) + " --cpu --kernel 9").exit_code, 2);  // scarf has no kernel
  EXPECT_EQ(run(digest + "--cpu --dump " + path("dump")).exit_code, 2);
}

TEST_F(Program, FiltersStandInFrontAndCount) {
  const std::string file = recording(3000) + " --filter support:period=300us --filter refractory:period=2ms";
  const Outcome reference = run("digest --cpu " + file);
  EXPECT_THAT(reference.out, HasSubstr("filter support: "));
  EXPECT_THAT(reference.out, HasSubstr("filter refractory: "));
  EXPECT_EQ(run("digest " + file).out, reference.out);
  const Outcome verified = run("verify " + file + " --batch 400");
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  EXPECT_EQ(run("digest --cpu " + recording(10) + " --filter support:range=9").exit_code, 2);
}

TEST_F(Program, ListsDevices) {
  const auto devices = list_devices();
  if (!devices) GTEST_SKIP() << devices.error().message;
  const Outcome outcome = run("devices");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const DeviceInfo& device : *devices) {
    EXPECT_THAT(outcome.out, HasSubstr(device.name));
    EXPECT_THAT(outcome.out, HasSubstr(device.uuid));
  }
}

TEST_F(Program, RealRecordingsHaveTheirKnownDigests) {
  const char* data = std::getenv("SCARF_DATA_DIR");
  if (!data) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  const std::string raw = std::string(data) + "/raw/";
  EXPECT_THAT(run("info --digest " + raw + "hd_evt3_driving.raw").out,
              HasSubstr("events 9bba5ca48301878102200069a89413a3240eaae3ff599d217f1c1a84d13fe7ba\n"));
  EXPECT_THAT(run("digest --cpu --preset light --batch random " + raw + "vga_evt2_sparks.raw").out,
              HasSubstr("events 58773c06cd3098d13e0f2781e1134449d2f01ed498d4975aabc2c4e5ec81d44b\n"));
}

}  // namespace
}  // namespace scarf::tools
