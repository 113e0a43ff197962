// Every sub-command tells of a recording that changes while it is read, and makes nothing of it.
#include <nlohmann/json.hpp>

#include "tests/support/archive_bytes.h"
#include "tests/tools/program.h"
#include "tests/tools/run_meanwhile.h"

namespace scarf::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr size_t kEvents = 400'000;  // long enough to read that the program is met at it

class ChangingRecording : public Program {
 protected:
  Outcome run_meanwhile(const std::string& arguments, const std::string& file,
                        const std::function<void()>& act, Met met = Met::open) {
    const std::string command =
        text("exec >", path("out"), " 2>", path("err"), "; exec ", SCARF_PROGRAM, " ", arguments);
    const int exit_code = tools::run_meanwhile(command, file, act, met);
    return {exit_code, content_of(path("out")), content_of(path("err"))};
  }

  static void expect_told(const Outcome& outcome, const std::string& file) {
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("scarf: "), HasSubstr(file + " changed while it was read ("),
                                   HasSubstr("read it again when it is complete")));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }

  static void append(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::app) << bytes;
  }
};

TEST_F(ChangingRecording, IsTheErrorOfEveryCommand) {
  const std::string file = recording(kEvents);
  for (const std::string command :
       {"info F", "info --json F", "digest --cpu F", "digest --cpu F --dump O/a.state", "convert F O/a.raw",
        "convert F O/a.h5", "convert --check F O/a.csv", "cut F O/b.raw --to 1100000",
        "render --cpu F -o O/end.png", "render --cpu F -o O/a.npy --rate 1"}) {
    SCOPED_TRACE(command);
    std::filesystem::create_directories(path("made"));
    std::string arguments = command;
    const auto put = [&](char letter, const std::string& name) {
      for (size_t at = 0; (at = arguments.find(letter, at)) != std::string::npos; at += name.size()) {
        arguments.replace(at, 1, name);
      }
    };
    put('F', "recording.txt");
    put('O', "made");
    const std::string there =
        text("cd ", path(""), "; exec >out 2>err; exec ", SCARF_PROGRAM, " ", arguments);
    const int exit_code = tools::run_meanwhile(there, file, [&] { append(file, "99 1 1 1\n"); });
    expect_told({exit_code, "", content_of(path("err"))}, "recording.txt");
    EXPECT_EQ(content_of(path("out")), "");
    EXPECT_TRUE(std::filesystem::is_empty(path("made")));
    std::filesystem::remove_all(path("made"));
  }
}

TEST_F(ChangingRecording, IsFoundByEveryKindOfChange) {
  const std::string file = recording(kEvents);
  const std::string content = content_of(file);
  const struct {
    const char* what;
    std::function<void()> change;
  } changes[] = {
      {"size ", [&] { append(file, "99 1 1 1\n"); }},
      {"size ", [&] { std::filesystem::resize_file(file, content.size() - 1'000'000); }},
      {"size ", [&] { std::filesystem::resize_file(file, 10); }},
      {"another file",
       [&] {
         write_text(path("other"), content);
         std::filesystem::rename(path("other"), file);
       }},
      {"time of modification", [&] { write_within(file, 20, content.substr(20, 5)); }},
      {"time of modification", [&] { set_modified(file, 1'500'000'000); }},
      {"content is another one",
       [&] {
         struct stat before {};
         ASSERT_EQ(stat(file.c_str(), &before), 0);
         write_within(file, 20, content[20] == '1' ? "2" : "1");
         const timespec times[2] = {before.st_atim, before.st_mtim};
         ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
       }},
      {"no longer there", [&] { std::filesystem::remove(file); }},
  };
  for (const auto& [what, change] : changes) {
    SCOPED_TRACE(what);
    std::filesystem::remove(file);
    write_text(file, content);
    const Outcome outcome = run_meanwhile("info " + file, file, change, Met::reading);
    expect_told(outcome, file);
    EXPECT_THAT(outcome.err, HasSubstr(what));
  }
}

TEST_F(ChangingRecording, RightsAndLinksAreNoChange) {
  const std::string file = recording(kEvents);
  const Outcome still = run("info --json --digest " + file);
  const Outcome outcome = run_meanwhile("info --json --digest " + file, file, [&] {
    std::filesystem::permissions(file, std::filesystem::perms::owner_read);
    std::filesystem::create_hard_link(file, file + ".link");
  });
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, still.out);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["schema"], 1);
}

TEST_F(ChangingRecording, IsFoundInBytesThatLibrariesRead) {
  const auto sink = create_events(path("rec.h5"), "dsec", kSensor);
  if (!sink) GTEST_SKIP() << sink.error().message;
  ASSERT_TRUE((*sink)->write(random_events(4 * kEvents, kSensor)).ok());
  ASSERT_TRUE((*sink)->finish().ok());
  const std::string file = path("rec.h5");
  expect_told(run_meanwhile("digest --cpu --geometry 64x48 " + file, file, [&] { append(file, "more"); }),
              file);
}

TEST_F(ChangingRecording, IsFoundInAnyFileOfAFolder) {
  recording(kEvents);
  std::filesystem::create_directories(path("seq/images"));
  std::filesystem::rename(path("recording.txt"), path("seq/events.txt"));
  const auto png = test::png_file(64, 48, std::vector<uint8_t>(size_t{64} * 48, 9));
  write_text(path("seq/images/a.png"), {png.begin(), png.end()});
  write_text(path("seq/images.txt"), "0.5 images/a.png\n");
  const std::string events = path("seq/events.txt");
  const std::string list = path("seq/images.txt");
  expect_told(
      run_meanwhile("digest --cpu " + path("seq"), events, [&] { append(list, "0.6 images/a.png\n"); }),
      list);
}

TEST_F(ChangingRecording, TriggersAreWatchedToTheirEnd) {
  const std::string file = path("triggers.raw");
  std::string bytes = "% evt 2.0\n% geometry 64x48\n% end\n";
  for (const uint32_t word : {0x80000001U, 0xA0000101U}) {
    for (int i = 0; i < (word >> 28 == 0xA ? 400'000 : 1); ++i) {
      bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
    }
  }
  write_text(file, bytes);
  expect_told(run_meanwhile("triggers " + file, file, [&] { append(file, "more"); }), file);
}

}  // namespace
}  // namespace scarf::tools
