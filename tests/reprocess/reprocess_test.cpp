// scarf reprocess from outside: results, records, failures, crashes, and several processes at once.
#include <gmock/gmock.h>

#include "scarf/io/recordings.h"
#include "tests/reprocess/reprocess_runs.h"
#include "tests/tools/event_fixtures.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;

constexpr SensorSize kSensor{64, 48};

class Reprocess : public ReprocessTest {
 protected:
  void record(const std::string& name, uint64_t seed, size_t count = 3000) {
    fs::create_directories(fs::path(path(name)).parent_path());
    auto sink = *create_events(path(name), seed % 2 == 0 ? "text" : "evt3", kSensor, {.overwrite = true});
    ASSERT_TRUE(sink->write(random_events(count, kSensor, seed)).ok());
    ASSERT_TRUE(sink->finish().ok());
  }
  // Six recordings in two folders, and two files that are none.
  void record_some(size_t count = 3000) {
    for (uint64_t i = 0; i < 6; ++i) record(text("in/", i < 3 ? "a/" : "b/", i, ".raw"), i, count);
    write_text(path("in/README.md"), "Once upon a time\nthere was a camera\n");
    write_text(path("in/a/notes.json"), "{}\n");
  }
};

TEST_F(Reprocess, MirrorsTheTreeWithPicturesAndRecords) {
  record_some();
  const Outcome outcome = run(in_to("out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("skipped: README.md: not a recording"));
  EXPECT_EQ(records("out").size(), 6u);
  EXPECT_TRUE(unfinished("out").empty());
  EXPECT_TRUE(fs::exists(path("out/b/4.raw.png")));
  const Json record = json_in(path("out/a/0.raw.json"));
  const Outcome digest = shell(text(SCARF_PROGRAM, " digest --cpu ", path("in/a/0.raw")));
  EXPECT_EQ(digest.out,
            text("state ", record["state"].get<std::string>(), "\nimage ", record["image"].get<std::string>(),
                 "\nevents ", record["events"].get<std::string>(), "\n"));
  const Outcome sum = shell(text("sha256sum ", path("in/a/0.raw")));
  EXPECT_EQ(sum.out.substr(0, 64), record["input_sha256"]);
  EXPECT_EQ(record["counts"]["events"], 3000);
  EXPECT_EQ(json_in(path("out/summary.json"))["totals"]["skipped"], 2);
  EXPECT_EQ(record["schema"], 1);
  EXPECT_EQ(json_in(path("out/summary.json"))["schema"], 1);
}

TEST_F(Reprocess, PipesInThePlaceOfItsFilesAreRefusedByName) {
  record("in/a.raw", 1);
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const auto expect_refused = [&](const std::string& arguments) {
    const Outcome outcome = shell(text("exec timeout 60 ", SCARF_PROGRAM, " ", arguments));
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2) << arguments << outcome.exit_code;
    EXPECT_THAT(outcome.err, HasSubstr("it is a pipe")) << arguments;
  };
  expect_refused("reprocess " + in_to("out", "--cpu --recipe " + path("pipe")));
  expect_refused(text("reprocess ", path("pipe"), " -o ", path("out"), " --cpu"));
  expect_refused(
      text("render --cpu ", path("in/a.raw"), " -o ", path("a.npy"), " --at-times ", path("pipe")));
  // An earlier record that is none is no reason to wait.
  fs::create_directory(path("out"));
  ASSERT_EQ(mkfifo(path("out/a.raw.json").c_str(), 0600), 0);
  EXPECT_EQ(
      shell(text("exec timeout 60 ", SCARF_PROGRAM, " reprocess ", in_to("out", "--cpu --resume"))).exit_code,
      2);
}

TEST_F(Reprocess, RecordsDependOnNeitherJobsNorTheDevice) {
  record_some();
  ASSERT_EQ(run(in_to("one", "--jobs 1")).exit_code, 0);
  ASSERT_EQ(run(in_to("two", "--jobs 2 --batch random:1")).exit_code, 0);
  ASSERT_EQ(run(in_to("cpu", "--jobs 2 --cpu")).exit_code, 0);
  EXPECT_EQ(records("one"), records("two"));
  EXPECT_EQ(records("one", false), records("cpu", false));
}

TEST_F(Reprocess, ARecipeHasSeveralOutputsAndInstantsOfASideFile) {
  record("in/a.raw", 1);
  record("in/b.raw", 3);
  write_text(path("in/a.times"), "# seconds\nx 1.01\nx 1.02\n");
  write_text(path("in/b.times"), "x 1.03\n");
  write_text(path("recipe.toml"),
             "representation = \"eros\"\nkernel = 5\noutput = [\".frames/\", \".png\", \".avi\"]\n"
             "at-times = \"{stem}.times\"\ntimes-column = 2\ntimes-unit = \"s\"\n"
             "[[input]]\nmatch = \"*.times\"\nskip = true\n");
  const Outcome outcome = run(in_to("out", "--cpu --recipe " + path("recipe.toml")));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(path("out/a.raw.frames/frame_000001.png")));
  EXPECT_FALSE(fs::exists(path("out/b.raw.frames/frame_000001.png")));
  EXPECT_TRUE(fs::exists(path("out/a.raw.avi")) && fs::exists(path("out/b.raw.png")));
  EXPECT_EQ(json_in(path("out/a.raw.json"))["counts"]["frames"], 2);
}

TEST_F(Reprocess, ARecipeHasTheProductsOfRender) {
  for (const FormatInfo& format : formats()) {
    if (!format.missing.empty()) GTEST_SKIP() << format.name << " needs " << format.missing;
  }
  record("in/a.raw", 1);
  write_text(path("recipe.toml"),
             "output = [\".png\", \".npy\", \".tensors.h5\"]\npixels = \"float\"\n"
             "encoding = \"voxel_grid:bins=5\"\nsparse = \".events.npz\"\nevery = 1000\n");
  for (const std::string machine : {"cpu", "device"}) {
    const Outcome outcome = run(
        in_to(machine, text(machine == "cpu" ? "--cpu" : "", " --verify 1 --recipe ", path("recipe.toml"))));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    const Json record = json_in(path(machine + "/a.raw.json"));
    EXPECT_EQ(record["outputs"], Json({".png", ".npy", ".tensors.h5", ".events.npz"}));
    EXPECT_EQ(record["counts"]["frames"], 3);
    const Outcome rendered = shell(text(SCARF_PROGRAM, " render --cpu ", path("in/a.raw"), " --overwrite -o ",
                                        path("rendered.npy"), " --pixels float --every 1000"));
    ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
    EXPECT_EQ(content_of(path(machine + "/a.raw.npy")), content_of(path("rendered.npy")));
    EXPECT_EQ(content_of(path(machine + "/a.raw.csv")), content_of(path("rendered.csv")));
    EXPECT_GT(fs::file_size(path(machine + "/a.raw.tensors.h5")), 0u);
    EXPECT_GT(fs::file_size(path(machine + "/a.raw.events.npz")), 0u);
  }
  EXPECT_EQ(records("cpu", false), records("device", false));
}

TEST_F(Reprocess, BadInputsAreToldAndTheRestGoesOn) {
  record_some();
  write_text(path("in/a/corrupt.raw"), "% format EVT3;height=720;width=huge\n% end\n");
  fs::create_symlink("nowhere", path("in/b/unreadable.raw"));
  const Outcome outcome = run(in_to("out", "--cpu --keep-going"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("failed: a/corrupt.raw: "));
  EXPECT_THAT(outcome.out, HasSubstr("failed: b/unreadable.raw: "));
  EXPECT_EQ(records("out").size(), 6u);
  const Outcome stopped = run(in_to("stopped"));
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_GT(json_in(path("stopped/summary.json"))["totals"]["not tried"], 0);
}

TEST_F(Reprocess, AListMustNameRecordings) {
  record_some();
  write_text(path("list"), "in/a/0.raw\nin/README.md\n");
  const Outcome outcome = run(text(path("list"), " -o ", path("out"), " --cpu --keep-going"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("failed: in/README.md: "));
  EXPECT_TRUE(fs::exists(path("out/in/a/0.raw.json")));
}

TEST_F(Reprocess, AFullDiskIsToldAndLeavesNothingBehind) {
  record_some();
  // A limit on the size of files stands in for the disk.
  const Outcome outcome = shell(text("(trap '' XFSZ; ulimit -f 0; exec ", SCARF_PROGRAM, " reprocess ",
                                     in_to("out", "--cpu --keep-going"), " 2>/dev/null) | cat"));
  EXPECT_THAT(outcome.out, HasSubstr("failed: a/0.raw: "));
  EXPECT_TRUE(records("out").empty());
  EXPECT_TRUE(unfinished("out").empty());
  const Outcome resumed = run(in_to("out", "--cpu --resume"));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(records("out").size(), 6u);
}

TEST_F(Reprocess, OneCorruptTimeDoesNotFillTheDisk) {
  fs::create_directory(path("in"));
  write_text(path("in/a.txt"), "64 48\n0.1 1 1 1\n9000000.0 1 1 1\n");
  write_text(path("recipe.toml"), "output = \".frames/\"\n");
  const Outcome outcome = run(in_to("out", text("--cpu --max-frames 100 --recipe ", path("recipe.toml"))));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("raise max-frames"));
  EXPECT_FALSE(fs::exists(path("out/a.txt.frames")));
}

TEST_F(Reprocess, ALongRecordingIsNoFlood) {
  fs::create_directory(path("in"));
  std::string lines = "%geometry:8,8\n";
  for (int i = 0; i < 12'000; ++i) lines += text(i % 8, ",", i / 8 % 8, ",", i % 2, ",", 1000 * i, "\n");
  write_text(path("in/long.csv"), lines);
  write_text(path("recipe.toml"), "output = \".npy\"\nrate = 1000\n");
  const Outcome outcome = run(in_to("out", "--cpu --recipe " + path("recipe.toml")));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(json_in(path("out/long.csv.json"))["counts"]["frames"], 11'999);
}

TEST_F(Reprocess, ARecordingWithoutAnEventHasFailedUnlessThatIsAllowed) {
  record("in/a.raw", 1);
  write_text(path("in/empty.csv"), "%geometry:64,48\n");
  const Outcome outcome = run(in_to("out", "--cpu --keep-going"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("failed: empty.csv: "));
  EXPECT_THAT(outcome.out, HasSubstr("allow-empty"));
  EXPECT_EQ(records("out").size(), 1u);
  EXPECT_FALSE(fs::exists(path("out/empty.csv.png")));
  EXPECT_EQ(run(in_to("allowed", "--cpu --allow-empty")).exit_code, 0);
  EXPECT_EQ(records("allowed").size(), 2u);
  write_text(path("recipe.toml"), "[[input]]\nmatch = \"empty.*\"\nallow-empty = true\n");
  EXPECT_EQ(run(in_to("by-recipe", "--cpu --recipe " + path("recipe.toml"))).exit_code, 0);
}

// A folder of a data set: what is no recording is passed over, what should have been one fails.
TEST_F(Reprocess, WhatLiesBesideRecordingsIsPassedOver) {
  record("in/seq/events.raw", 1);
  const std::string header = "% evt 3.0\n% format EVT3;height=48;width=64\n";
  std::string index = header + "% bookmark_period_us 2000\n% index_version 2.0\n% end\n";
  for (int i = 0; i < 2000; ++i) index += static_cast<char>(i * 37);
  write_text(path("in/seq/events.raw.tmp_index"), index);
  for (const auto& [name, content] : std::initializer_list<std::pair<const char*, std::string>>{
           {"imu.txt", "1600000000.1 0.1 0.2 9.8 0 0 0\n"},
           {"imu.csv", "timestamp,ax,ay,az,gx,gy,gz\n1.5,0,0,9.8,0,0,0\n"},
           {"stamped_groundtruth.txt", "# time tx ty tz qx qy qz qw\n1600000000.1 0 0 0 0 0 0 1\n"},
           {"groundtruth.txt", "10,20,30,40\n11,20,30,40\n"},
           {"boxes.csv", "ts,x,y,w,h,class_id\n100,10,20,30,40,1\n"},
           {"timestamps.txt", "49599300523\n49599350523\n"},
           {"cam_to_cam.yaml", "intrinsics:\n  cam0:\n    camera_matrix: [1, 1, 1, 1]\n"},
           {"image.png", "\x89PNG\r\n\x1a\n and so on"},
           {"image.jpg", "\xff\xd8\xff\xe0 and so on"},
           {"events.csv.gz", "\x1f\x8b\b and so on"},
           {"index.html", "<!DOCTYPE html><html></html>\n"},
           {"absent.txt", ""}}) {
    write_text(path(text("in/seq/", name)), content);
  }
  const Outcome outcome = run(in_to("out"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(records("out").size(), 1u);
  EXPECT_EQ(json_in(path("out/summary.json"))["totals"]["skipped"], 13);

  write_text(path("in/seq/left.raw"), "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n");
  write_text(path("in/seq/right.aedat4"), "<html><body>quota exceeded</body></html>\n");
  write_text(path("in/seq/third.h5"), "");
  write_text(path("in/seq/fourth.zip"), "PK\x03\x04 cut");
  write_text(path("in/seq/zeit.csv"), "zeit;x;y;polarity\n1;2;3;1\n");
  const Outcome failed = run(in_to("failed", "--cpu --keep-going"));
  EXPECT_EQ(failed.exit_code, 1);
  for (const char* name : {"left.raw", "right.aedat4", "third.h5", "fourth.zip", "zeit.csv"}) {
    EXPECT_THAT(failed.out, HasSubstr(text("failed: seq/", name, ": ")));
  }
  EXPECT_EQ(json_in(path("failed/summary.json"))["totals"]["failed"], 5);
  EXPECT_EQ(records("failed").size(), 1u);
}

TEST_F(Reprocess, ResumeKeepsWhatIsFinished) {
  record_some();
  ASSERT_EQ(run(in_to("out")).exit_code, 0);
  EXPECT_EQ(run(in_to("out")).exit_code, 2);  // would write over results
  const auto inode = [&](const std::string& name) {
    struct stat status {};
    EXPECT_EQ(stat(path(name).c_str(), &status), 0);
    return status.st_ino;
  };
  const auto kept = inode("out/a/1.raw.json");
  const auto before = records("out");
  fs::remove(path("out/a/0.raw.png"));
  record("in/b/3.raw", 9);  // another content, later than its record
  ASSERT_EQ(run(in_to("out", "--cpu --resume")).exit_code, 0);
  EXPECT_EQ(inode("out/a/1.raw.json"), kept);
  EXPECT_TRUE(fs::exists(path("out/a/0.raw.png")));
  const auto after = records("out");
  EXPECT_NE(after.at("b/3.raw.json"), before.at("b/3.raw.json"));
  EXPECT_EQ(after.at("a/0.raw.json"), before.at("a/0.raw.json"));
  const Json totals = json_in(path("out/summary.json"))["totals"];
  EXPECT_EQ(totals["done"], 2);
  EXPECT_EQ(totals["finished before"], 4);
}

TEST_F(Reprocess, VerifyFindsAWrongDigest) {
  record_some();
  const Outcome good = run(in_to("out", "--jobs 2 --verify 0.5 --seed 3"));
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("3 recordings (share 0.5, seed 3), 3 identical"));
  Json record = json_in(path("out/a/1.raw.json"));
  record["state"] = std::string(64, '0');
  write_text(path("out/a/1.raw.json"), record.dump());
  const Outcome bad = run(in_to("out", "--cpu --resume --verify 1"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("check differs: a/1.raw: on the CPU reference differ: state"));
}

TEST_F(Reprocess, KilledAtAnyMomentItResumesToTheSameResults) {
  record_some(40'000);
  write_text(path("recipe.toml"), "output = [\".png\", \".frames/\"]\nevery = 4000\n");
  const std::string more = text("--cpu --jobs 2 --resume --recipe ", path("recipe.toml"));
  ASSERT_EQ(run(in_to("whole", more)).exit_code, 0);
  ASSERT_NO_FATAL_FAILURE(kill_twenty_times("out", in_to("out", more), 170));
  ASSERT_EQ(run(in_to("out", more)).exit_code, 0);
  EXPECT_EQ(records("out"), records("whole"));
  EXPECT_TRUE(unfinished("out").empty());
}

TEST_F(Reprocess, ShardsDoEverythingOnce) {
  record_some();
  size_t done = 0;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    ASSERT_EQ(run(in_to("out", text("--cpu --shard ", shard))).exit_code, 0) << shard;
    const std::string name = text("out/summary.", shard[0], "-of-3.json");
    done += json_in(path(name))["totals"]["done"].get<size_t>();
  }
  EXPECT_EQ(done, 6u);
  EXPECT_EQ(records("out").size(), 6u);
}

TEST_F(Reprocess, RanksOfAnMpiJobShareTheWork) {
  if (std::system("command -v mpirun >/dev/null") != 0) GTEST_SKIP() << "mpirun is not installed";
  record_some();
  ASSERT_EQ(run(in_to("alone")).exit_code, 0);
  const Outcome outcome = shell(text("mpirun --allow-run-as-root --oversubscribe -n 4 ", SCARF_PROGRAM,
                                     " reprocess ", in_to("out", "--cpu --jobs 1")));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(records("out"), records("alone"));
#ifdef SCARF_HAS_MPI
  EXPECT_THAT(outcome.out, HasSubstr("each of 4 processes"));
  EXPECT_EQ(json_in(path("out/summary.json"))["totals"]["done"], 6);
#else
  EXPECT_TRUE(fs::exists(path("out/summary.4-of-4.json")));
#endif
}

TEST_F(Reprocess, TasksOfASlurmArrayShareTheWork) {
  if (std::system("command -v slurmctld slurmd munged sbatch >/dev/null") != 0) {
    GTEST_SKIP() << "slurmctld, slurmd, munged or sbatch is not installed (slurm-wlm)";
  }
  if (geteuid() != 0) GTEST_SKIP() << "the daemons of Slurm need root";
  record_some();
  const Outcome outcome = shell(text("bash ", SCARF_SLURM_SCRIPT, " ", path("slurm"), " '", SCARF_PROGRAM,
                                     " reprocess ", in_to("out", "--cpu --jobs 1"), "'"));
  if (outcome.exit_code == 77) GTEST_SKIP() << "Slurm does not start here: " << outcome.err;
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(records("out").size(), 6u);
  for (const char* shard : {"1", "2", "3"}) {
    EXPECT_TRUE(fs::exists(path(text("out/summary.", shard, "-of-3.json")))) << shard;
  }
}

// Everything below a folder that is not new: names, permissions, bytes.
std::map<std::string, std::string> everything(const std::string& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto mode = static_cast<unsigned>(entry.status().permissions());
    found[entry.path().string()] =
        text(mode, entry.is_regular_file() ? content_of(entry.path().string()) : std::string());
  }
  return found;
}

TEST_F(Reprocess, ResultsNeverTakeThePlaceOfInputs) {
  record("in/rec.raw", 1);
  for (const auto& [output, victim] :
       {std::pair{".h5", "rec.raw.h5"}, std::pair{".npy", "rec.raw.csv"}, std::pair{".png", "rec.raw.png"},
        std::pair{".png", "rec.raw.json"}, std::pair{".frames/", "rec.raw.frames"}}) {
    const std::string file = path(text("in/", victim));
    fs::create_hard_link(path("in/rec.raw"), file);
    write_text(path("recipe.toml"), text("output = [\"", output, "\"]\n"));
    const auto before = everything(path("in"));
    for (const char* more : {"", " --resume", " --overwrite"}) {
      const Outcome outcome = run(in_to("in", text("--cpu --recipe ", path("recipe.toml"), more)));
      EXPECT_EQ(outcome.exit_code, 2) << output << more << outcome.out;
      EXPECT_THAT(outcome.err, HasSubstr("rec.raw"));
      EXPECT_EQ(everything(path("in")), before) << output << more;
    }
    fs::remove(file);
  }
  // A list, a recipe and a file of times are inputs as well.
  write_text(path("in/rec.raw.json"), "in/rec.raw\n");
  EXPECT_EQ(run(text(path("in/rec.raw.json"), " --cpu --overwrite -o ", path("in"))).exit_code, 1);
  EXPECT_EQ(content_of(path("in/rec.raw.json")), "in/rec.raw\n");
}

TEST_F(Reprocess, WhatScarfHasNotWrittenStays) {
  record("in/a.raw", 1);
  write_text(path("recipe.toml"), "output = [\".frames/\", \".npy\"]\n");
  const std::string more = text("--cpu --recipe ", path("recipe.toml"));
  for (const std::string foreign : {"a.raw.frames/notes.txt", "a.raw.npy", "a.raw.csv", "a.raw.json",
                                    "a.raw.tmp/notes.txt", "summary.json", ".a.raw.scarf-files"}) {
    fs::create_directories(fs::path(path("out/" + foreign)).parent_path());
    write_text(path("out/" + foreign), "{\"my\": \"notes\"}");
    const auto before = everything(path("out"));
    for (const std::string how : {"", " --resume", " --overwrite"}) {
      const Outcome outcome = run(in_to("out", more + how));
      EXPECT_EQ(outcome.exit_code, 2) << foreign << how << outcome.out;
      EXPECT_EQ(everything(path("out")), before) << foreign << how;
    }
    fs::remove_all(path("out"));
  }
}

TEST_F(Reprocess, OverwriteReplacesWhatScarfHasWrittenAndNothingElse) {
  record("in/a.raw", 1);
  write_text(path("recipe.toml"), "output = [\".frames/\", \".npy\"]\nevery = 1000\n");
  const std::string more = text("--cpu --recipe ", path("recipe.toml"));
  ASSERT_EQ(run(in_to("out", more)).exit_code, 0);
  EXPECT_EQ(run(in_to("out", more)).exit_code, 2);
  const auto before = records("out");
  write_text(path("out/notes.txt"), "precious");
  ASSERT_EQ(run(in_to("out", more + " --overwrite")).exit_code, 0);
  EXPECT_EQ(records("out"), before);
  // Another recipe: what is not made any more goes away.
  ASSERT_EQ(run(in_to("out", "--cpu --overwrite")).exit_code, 0);
  EXPECT_TRUE(fs::exists(path("out/a.raw.png")));
  EXPECT_FALSE(fs::exists(path("out/a.raw.npy")) || fs::exists(path("out/a.raw.frames")));
  EXPECT_EQ(content_of(path("out/notes.txt")), "precious");
  // What someone has changed or added belongs to him.
  ASSERT_EQ(run(in_to("out", more + " --overwrite")).exit_code, 0);
  write_text(path("out/a.raw.frames/notes.txt"), "precious");
  EXPECT_EQ(run(in_to("out", more + " --overwrite")).exit_code, 2);
  EXPECT_EQ(content_of(path("out/a.raw.frames/notes.txt")), "precious");
  const Json list = Json::parse(content_of(path("out/.a.raw.scarf-files")));
  EXPECT_EQ(list["schema"], 1);
  EXPECT_EQ(list["files"].size(), 4u);
}

TEST_F(Reprocess, ResultsBesideTheirRecordingsAreNoRecordings) {
  record("in/a.raw", 1);
  ASSERT_EQ(run(in_to("in")).exit_code, 0);
  const Outcome again = run(in_to("in", "--cpu --resume"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json_in(path("in/summary.json"))["totals"]["files"], 1);
}

TEST_F(Reprocess, ASignalLeavesNothingUnfinished) {
  record("in/a.raw", 1, 400'000);
  write_text(path("recipe.toml"), "output = [\".frames/\", \".npy\"]\nevery = 1000\nsparse = \".npz\"\n");
  const auto before = everything(path("in"));
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const Outcome outcome =
        shell(text("timeout --foreground -s ", signal, " 1 ", SCARF_PROGRAM, " reprocess ",
                   in_to("out", text("--cpu --batch 100 --recipe ", path("recipe.toml"))), "; true"));
    if (!fs::exists(path("out"))) continue;
    if (fs::exists(path("out/a.raw.json"))) GTEST_SKIP() << "finished before the signal came";
    EXPECT_TRUE(everything(path("out")).empty()) << signal << " " << everything(path("out")).begin()->first;
    fs::remove_all(path("out"));
  }
  EXPECT_EQ(everything(path("in")), before);
}

TEST_F(Reprocess, BadUsageExitsWithTwo) {
  record_some();
  write_text(path("recipe.toml"), "kernal = 3\n");
  for (const std::string& more :
       {std::string("--shard 0/3"), std::string("--jobs 0"), std::string("--verify 2"),
        std::string("--seed 1"), text("--recipe ", path("recipe.toml"))}) {
    EXPECT_EQ(run(in_to("out", "--cpu " + more)).exit_code, 2) << more;
    EXPECT_FALSE(fs::exists(path("out"))) << more;
  }
  EXPECT_EQ(run(path("missing") + " --cpu -o " + path("out")).exit_code, 1);
}

}  // namespace
}  // namespace scarf::tools
