// A record is of exactly the bytes whose events were counted; --resume keeps nothing of other bytes.
#include <gmock/gmock.h>
#include <unistd.h>

#include "scarf/io/recordings.h"
#include "tests/reprocess/reprocess_runs.h"
#include "tests/support/archive_bytes.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/run_meanwhile.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;

constexpr SensorSize kSensor{64, 48};
constexpr time_t kOld = 1'500'000'000;

class ChangingInputs : public ReprocessTest {
 protected:
  void record(const std::string& name, const std::string& format, size_t count = 3000) {
    fs::create_directories(fs::path(path(name)).parent_path());
    auto sink = create_events(path(name), format, kSensor);
    ASSERT_TRUE(sink.ok()) << sink.error().message;
    ASSERT_TRUE((*sink)->write(random_events(count, kSensor, 5)).ok());
    ASSERT_TRUE((*sink)->finish().ok());
  }
  // Another event in the middle of a text recording of the same size.
  void change_within(const std::string& name) {
    const std::string content = content_of(path(name));
    const size_t line = content.find('\n', content.size() / 2);
    const size_t last = content.find('\n', line + 1) - 1;  // the polarity
    write_within(path(name), static_cast<std::streamoff>(last), content[last] == '1' ? "0" : "1");
  }
  // Another digest in a record, which shows whether the record was kept unread.
  void mark(const std::string& record) {
    Json json = json_in(path(record));
    json["state"] = "kept";
    edit(record, json);
  }
  // Leaves the record what scarf takes for its own: of the same size and time.
  void edit(const std::string& record, const Json& json) {
    const auto time = fs::last_write_time(path(record));
    std::string content = json.dump();
    content.resize(fs::file_size(path(record)), ' ');
    write_text(path(record), content);
    fs::last_write_time(path(record), time);
  }
  bool is_marked(const std::string& record) { return json_in(path(record))["state"] == "kept"; }
  std::string sha256_of(const std::string& name) {
    return shell(text("sha256sum ", path(name))).out.substr(0, 64);
  }
};

TEST_F(ChangingInputs, AreFailuresWithoutARecord) {
  record("in/small.txt", "text");
  record("in/big.txt", "text", 400'000);
  const std::string big = path("in/big.txt");
  const std::string content = content_of(big);
  const std::function<void()> changes[] = {
      [&] { std::ofstream(big, std::ios::app) << "99 1 1 1\n"; },
      [&] { fs::resize_file(big, 1'000'000); },
      [&] {
        write_text(path("other"), content);
        fs::rename(path("other"), big);
      },
      [&] { change_within("in/big.txt"); },
      [&] { set_modified(big, kOld); },
  };
  for (const auto& change : changes) {
    fs::remove_all(path("out"));
    fs::remove(big);
    write_text(big, content);
    const int exit_code =
        run_meanwhile(text("exec >", path("stdout"), " 2>", path("stderr"), "; exec ", SCARF_PROGRAM,
                           " reprocess --keep-going --jobs 1 ", in_to("out")),
                      big, change);
    EXPECT_EQ(exit_code, 1);
    EXPECT_THAT(content_of(path("stdout")),
                HasSubstr("failed: big.txt: " + big + " changed while it was read ("));
    EXPECT_FALSE(fs::exists(path("out/big.txt.json")));
    EXPECT_FALSE(fs::exists(path("out/big.txt.png")));
    EXPECT_TRUE(unfinished("out").empty());
    EXPECT_TRUE(fs::exists(path("out/small.txt.json")));
    EXPECT_EQ(json_in(path("out/summary.json"))["totals"]["failed"], 1);
  }
}

TEST_F(ChangingInputs, OtherRightsAreNoFailure) {
  record("in/big.txt", "text", 400'000);
  const std::string big = path("in/big.txt");
  const int exit_code = run_meanwhile(text("exec >", path("stdout"), " 2>", path("stderr"), "; exec ",
                                           SCARF_PROGRAM, " reprocess ", in_to("out")),
                                      big, [&] { fs::permissions(big, fs::perms::owner_read); });
  EXPECT_EQ(exit_code, 0) << content_of(path("stdout"));
  EXPECT_EQ(json_in(path("out/big.txt.json"))["input_sha256"], sha256_of("in/big.txt"));
}

TEST_F(ChangingInputs, AnyFileOfAFolderCounts) {
  record("in/seq/events.txt", "text", 400'000);
  fs::create_directories(path("in/seq/images"));
  const auto png = test::png_file(64, 48, std::vector<uint8_t>(size_t{64} * 48, 9));
  write_text(path("in/seq/images/a.png"), {png.begin(), png.end()});
  write_text(path("in/seq/images.txt"), "0.5 images/a.png\n");
  write_text(path("in/seq/calib.txt"), "1 2 3\n");
  // A list: to find the recordings of a folder, each is opened once before its turn.
  write_text(path("in/list"), "seq\n");
  const std::string arguments = text(path("in/list"), " -o ", path("out"), " --cpu");
  for (const std::string name : {"calib.txt", "new.txt"}) {
    fs::remove_all(path("out"));
    const int exit_code = run_meanwhile(
        text("exec >", path("stdout"), " 2>", path("stderr"), "; exec ", SCARF_PROGRAM, " reprocess ",
             arguments),
        path("in/seq/events.txt"), [&] { std::ofstream(path("in/seq/" + name), std::ios::app) << "4\n"; });
    EXPECT_EQ(exit_code, 1);
    EXPECT_THAT(content_of(path("stdout")), HasSubstr("changed while it was read (" + name));
    EXPECT_FALSE(fs::exists(path("out/seq.json")));
  }
  fs::remove_all(path("out"));
  ASSERT_EQ(run(arguments).exit_code, 0);
  mark("out/seq.json");
  ASSERT_EQ(run(arguments + " --resume").exit_code, 0);
  EXPECT_TRUE(is_marked("out/seq.json"));
  set_modified(path("in/seq/calib.txt"), kOld);  // its content is the same
  ASSERT_EQ(run(arguments + " --resume").exit_code, 0);
  EXPECT_TRUE(is_marked("out/seq.json"));
  write_text(path("in/seq/calib.txt"), "1 2 3\n5\n");
  set_modified(path("in/seq/calib.txt"), kOld);
  ASSERT_EQ(run(arguments + " --resume").exit_code, 0);
  EXPECT_FALSE(is_marked("out/seq.json"));
}

TEST_F(ChangingInputs, ResultsWithinAFolderAreNoneOfIt) {
  record("seq/events.txt", "text");
  const std::string arguments = text(path("seq"), " -o ", path("seq/out"), " --cpu");
  ASSERT_EQ(run(arguments).exit_code, 0);
  const Json record = json_in(path("seq/out/seq.json"));
  EXPECT_EQ(record["input_bytes"], fs::file_size(path("seq/events.txt")));
  mark("seq/out/seq.json");
  ASSERT_EQ(run(arguments + " --resume").exit_code, 0);
  EXPECT_TRUE(is_marked("seq/out/seq.json"));
}

TEST_F(ChangingInputs, ADigestIsOfAllBytesOfAFileWhoeverReadsIt) {
  for (const FormatInfo& format : formats()) {
    if (format.written && format.recognised && format.missing.empty()) {
      record("in/" + format.name, format.name, 30'000);
    }
  }
  run(in_to("out", "--cpu --keep-going"));
  const auto found = records("out");
  EXPECT_GE(found.size(), 6u);
  for (const auto& [name, record] : found) {
    const std::string input = "in/" + record["input"].get<std::string>();
    EXPECT_EQ(record["input_sha256"], sha256_of(input)) << input;
    EXPECT_EQ(record["input_bytes"], fs::file_size(path(input))) << input;
  }
}

TEST_F(ChangingInputs, ResumeDoesNotTrustTimes) {
  const auto fresh = [&] {
    fs::remove_all(path("in"));
    fs::remove_all(path("out"));
    record("in/rec.txt", "text");
    set_modified(path("in/rec.txt"), kOld);
    ASSERT_EQ(run(in_to("out")).exit_code, 0);
    mark("out/rec.txt.json");
  };
  const auto kept = [&] {
    const Outcome outcome = run(in_to("out", "--cpu --resume"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return is_marked("out/rec.txt.json");
  };
  fresh();
  EXPECT_TRUE(kept()) << "nothing has changed";
  fs::permissions(path("in/rec.txt"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(kept()) << "the same content";
  set_modified(path("in/rec.txt"), kOld + 5);
  EXPECT_TRUE(kept()) << "the same content";
  for (const time_t time : {kOld - 1000, kOld, kOld + 1000}) {  // as rsync -a, cp -p and tar set it
    fresh();
    change_within("in/rec.txt");
    set_modified(path("in/rec.txt"), time);
    EXPECT_FALSE(kept()) << time;
    EXPECT_EQ(json_in(path("out/rec.txt.json"))["input_sha256"], sha256_of("in/rec.txt"));
  }
  fresh();
  const fs::path other = path("other.txt");
  fs::copy_file(path("in/rec.txt"), other);
  change_within("other.txt");
  set_modified(other.string(), kOld);
  fs::rename(other, path("in/rec.txt"));
  EXPECT_FALSE(kept()) << "another file has taken its place";
  // A record of before the times were noted.
  fresh();
  Json old = json_in(path("out/rec.txt.json"));
  old.erase("schema");
  old.erase("input_state");
  edit("out/rec.txt.json", old);
  EXPECT_TRUE(kept());
  change_within("in/rec.txt");
  set_modified(path("in/rec.txt"), kOld);
  EXPECT_FALSE(kept());
}

TEST_F(ChangingInputs, TheFileOfTheInstantsIsAnInput) {
  record("in/rec.txt", "text");
  write_text(path("in/rec_times.csv"), "1010000\n1020000\n");
  write_text(path("recipe.toml"),
             "output = \".frames/\"\n[[input]]\nmatch = \"*.csv\"\nskip = true\n"
             "[[input]]\nmatch = \"*.txt\"\nat-times = \"{stem}_times.csv\"\ntimes-unit = \"us\"\n");
  const std::string more = text("--cpu --recipe ", path("recipe.toml"));
  ASSERT_EQ(run(in_to("out", more)).exit_code, 0) << content_of(path("stderr"));
  EXPECT_EQ(json_in(path("out/rec.txt.json"))["times_sha256"], sha256_of("in/rec_times.csv"));
  EXPECT_TRUE(fs::exists(path("out/rec.txt.frames/frame_000001.png")));
  mark("out/rec.txt.json");
  ASSERT_EQ(run(in_to("out", more + " --resume")).exit_code, 0);
  EXPECT_TRUE(is_marked("out/rec.txt.json"));
  write_text(path("in/rec_times.csv"), "1010000\n1040000\n");
  set_modified(path("in/rec_times.csv"), kOld);
  ASSERT_EQ(run(in_to("out", more + " --resume")).exit_code, 0);
  EXPECT_FALSE(is_marked("out/rec.txt.json"));
}

TEST_F(ChangingInputs, WhatHasJustChangedIsNotKnownByItsTimes) {
  record("in/rec.txt", "text");
  ASSERT_EQ(run(in_to("out")).exit_code, 0);
  EXPECT_TRUE(json_in(path("out/rec.txt.json"))["input_state"].is_null());
  sleep(3);  // longer than the steps in which any file system counts time
  fs::remove_all(path("out"));
  ASSERT_EQ(run(in_to("out")).exit_code, 0);
  Json record = json_in(path("out/rec.txt.json"));
  struct stat status {};
  ASSERT_EQ(stat(path("in/rec.txt").c_str(), &status), 0);
  EXPECT_EQ(record["input_state"]["inode"], status.st_ino);
  EXPECT_EQ(record["input_state"]["modified_ns"].get<int64_t>() / 1'000'000'000, status.st_mtim.tv_sec);
  EXPECT_EQ(record["input_state"]["changed_ns"].get<int64_t>() % 1'000'000'000, status.st_ctim.tv_nsec);
  // These times are enough: the digest is not looked at.
  record["input_sha256"] = "of something else";
  record["state"] = "kept";
  edit("out/rec.txt.json", record);
  ASSERT_EQ(run(in_to("out", "--cpu --resume")).exit_code, 0);
  EXPECT_TRUE(is_marked("out/rec.txt.json"));
  fs::permissions(path("in/rec.txt"), fs::perms::owner_read);
  ASSERT_EQ(run(in_to("out", "--cpu --resume")).exit_code, 0);
  EXPECT_FALSE(is_marked("out/rec.txt.json")) << "the digest decides";
}

}  // namespace
}  // namespace scarf::tools
