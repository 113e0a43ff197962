// No sub-command destroys what is not its own: every option that names an output, with every file of the user
// on it.
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include "scarf/digest/digest.h"
#include "tests/tools/program.h"
#include "tools/commands.h"
#include "tools/file_options.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// All that the user has: names, kinds, permissions, bytes, where links lead.
using Snapshot = std::map<std::string, std::string>;

Snapshot snapshot(const std::string& folder) {
  Snapshot found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto status = entry.symlink_status();
    std::string content;
    if (fs::is_symlink(status)) content = fs::read_symlink(entry.path()).string();
    if (fs::is_regular_file(status)) content = content_of(entry.path().string());
    found[entry.path().lexically_relative(folder).string()] =
        text(static_cast<int>(status.type()), " ", static_cast<unsigned>(status.permissions()), " ", content);
  }
  return found;
}

// A way to name an output: {out} in the arguments is the name that is tried, {in} the recording.
struct Use {
  std::string command;
  std::string option;
  std::string arguments;
  std::string extension;    // of the name that is tried
  std::string victim = {};  // the input to lose, in place of the recording itself
  bool folder = false;      // the output is one
};

// With every use of an option whose writer is another one, and with files that are written without being
// named.
std::vector<Use> all_uses() {
  std::vector<Use> uses = {
      {"convert", "output", "convert {in} {out} --output-format text", ".raw"},
      {"cut", "output", "cut {in} {out} --events 0:10 --output-format evt3", ".raw"},
      {"digest", "--dump", "digest {in} --cpu --dump {out}", ".state"},
      {"triggers", "--output", "triggers {in} -o {out}", ".csv"},
      {"verify", "--failing", "verify {in} --failing {out}", ".txt"},
      {"frames", "--output", "frames {user}/ecd -o {out}", "", "ecd", true},
      {"frames", "--output", "frames {user}/ecd -o {out}", "", "ecd/images", true},
      {"simulate", "output", "simulate {out} --format text --duration 0.01", ".txt"},
      {"simulate", "--truth", "simulate {user}/s.txt --duration 0.01 --truth {out}", "", "ecd/images", true},
      {"render", "--output", "render {in} --cpu -o {out}", "", "ecd/images", true},
      {"render", "--output", "render {user}/ecd --geometry 64x48 --cpu -o {out}", "", "ecd", true},
      {"render", "--sparse", "render {in} --cpu -o {user}/o.npy --sparse {out}", ".h5"},
      {"render", "--sparse", "render {in} --cpu -o {user}/o.npy --sparse {out}", ".npz"},
      {"render", "--output", "render {in} --cpu --encoding tore -o {out}", ".h5"},
      {"reprocess", "--output", "reprocess {user}/in --cpu -o {out}", "", "in", true},
      {"bench", "--json", "bench --quick --wire --recordings {in} --json {out}", ".json"},
      {"bench", "--csv", "bench --quick --paper --cpu --file {in} --csv {out}", ".csv"},
      {"bench", "--plot", "bench --quick --paper --cpu --file {in} --plot {out}", ".svg"},
  };
  for (const char* extension : {".png", ".pgm", ".mp4", ".avi", ".npy", ".h5"}) {
    uses.push_back({"render", "--output", "render {in} --cpu -o {out}", extension});
  }
  for (const char* extension : {".mp4", ".npy"}) {
    uses.push_back({"render", "--output",
                    text("render {in} --cpu --at-times {user}/times", extension, " -o {out}"), extension,
                    text("times", extension)});
  }
  return uses;
}

std::string filled(std::string arguments, const std::map<std::string, std::string>& words) {
  for (const auto& [word, value] : words) {
    for (size_t at = 0; (at = arguments.find(word, at)) != arguments.npos; at += value.size())
      arguments.replace(at, word.size(), value);
  }
  return arguments;
}

class Outputs : public Program {
 protected:
  std::string user(const std::string& name) const { return path("user/" + name); }

  // A recording of its own format by that name, files of times, a data set with images, and files of others.
  void make_user(const std::string& extension) {
    fs::remove_all(path("user"));
    fs::create_directories(user("ecd/images"));
    fs::create_directories(user("in"));
    fs::create_directories(user("sub"));
    fs::copy_file(recording(300), user("rec" + extension));
    fs::permissions(user("rec" + extension), fs::perms::owner_read | fs::perms::owner_write);
    fs::copy_file(path("recording.txt"), user("in/rec.raw"));
    fs::create_hard_link(user("in/rec.raw"), user("in/rec.raw.png"));
    write_text(user("times" + extension), text(events_[100].t, "\n"));
    write_text(user("ecd/events.txt"), "0.000100000 1 2 1\n0.000300000 3 4 0\n");
    write_text(user("ecd/images.txt"), "0.000200000 images/frame_00000000.png\n");
    cv::imwrite(user("ecd/images/frame_00000000.png"), cv::Mat(48, 64, CV_8UC1, cv::Scalar(7)));
    write_text(user("foreign" + extension), "precious");
  }

  // Runs it without and with --overwrite, or with it alone where the name says enough; it must say what is in
  // the way and leave everything as it is.
  void expect_refused(const Use& use, const std::string& out, const std::string& naming,
                      bool only_plain = false) {
    const Snapshot before = snapshot(path("user"));
    for (const char* more : {"", " --overwrite"}) {
      if (only_plain && *more != '\0') continue;
      if (naming.starts_with("by a ") && *more == '\0') continue;  // would be refused for being there
      const std::string line =
          filled(use.arguments + more,
                 {{"{user}", path("user")}, {"{in}", user("rec" + use.extension)}, {"{out}", out}});
      const Outcome outcome = run(line);
#ifndef NDEBUG
      if (use.command == "bench") continue;  // refuses everything
#endif
      EXPECT_EQ(outcome.exit_code, 2) << naming << ": " << line << "\n" << outcome.out << outcome.err;
      EXPECT_FALSE(outcome.err.empty()) << line;
      EXPECT_TRUE(snapshot(path("user")) == before) << naming << ": " << line;
    }
  }
};

TEST_F(Outputs, EveryOptionThatNamesAnOutputSparesEveryInput) {
  std::set<std::pair<std::string, std::string>> tried;
  for (const Use& use : all_uses()) {
    tried.insert({use.command, use.option});
    make_user(use.extension);
    const std::string victim = use.victim.empty() ? "rec" + use.extension : use.victim;
    const bool has_input =
        use.command != "simulate" && (use.folder || use.arguments.find('{') != std::string::npos);
    if (has_input || use.folder) {
      expect_refused(use, user(victim), "by its name");
      expect_refused(use, user("sub/../" + victim), "by a relative path");
      fs::create_directory_symlink(path("user"), user("sub/up"));
      expect_refused(use, user("sub/up/" + victim), "through a linked folder");
      fs::create_symlink(user(victim), user("link" + use.extension));
      expect_refused(use, user("link" + use.extension), "by a symbolic link");
      if (!use.folder) {
        fs::create_hard_link(user(victim), user("hard" + use.extension));
        expect_refused(use, user("hard" + use.extension), "by a hard link");
      }
    }
    if (use.folder) {
      expect_refused(use, user("foreign"), "a file in place of the folder");
      if (use.command == "reprocess") continue;
      fs::create_directory(user("pictures"));
      write_text(user("pictures/frames.csv"), "precious");
      expect_refused(use, user("pictures"), "a list of pictures of others");
    } else {
      expect_refused(use, user("foreign" + use.extension), "a file of others", /*only_plain=*/true);
      fs::create_symlink(user("foreign" + use.extension), user("to_foreign" + use.extension));
      expect_refused(use, user("to_foreign" + use.extension), "a link to a file of others");
      fs::create_symlink(user("nothing"), user("dangling" + use.extension));
      expect_refused(use, user("dangling" + use.extension), "a link to nothing");
      if (use.command == "render" && use.option == "--output") continue;  // that is another kind of output
      fs::create_directory(user("folder" + use.extension));
      expect_refused(use, user("folder" + use.extension), "a folder");
    }
  }

  // The program's own list of its options says which there are.
  CLI::App program;
  Command command;
  add_commands(program, command);
  for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; })) {
    bool writes = false;
    for (const CLI::Option* option : app->get_options()) {
      const std::string type = option->get_type_name();
      const std::string name = option->get_name();
      // Text that says neither that it names a file nor that it does not.
      EXPECT_NE(type, "TEXT") << app->get_name() << " " << name << ": see tools/file_options.h";
      if (type != kOutputType) continue;
      writes = true;
      EXPECT_TRUE(tried.contains({app->get_name(), name}))
          << app->get_name() << " " << name << " is not tried";
    }
    EXPECT_EQ(app->get_option_no_throw("--overwrite") != nullptr, writes) << app->get_name();
  }
}

TEST_F(Outputs, FilesBesideTheNamedOneCountAsWell) {
  make_user(".csv");  // the list of the frames of rec.npy is rec.csv
  const Use use{"render", "--output", "render {in} --cpu -o {out}", ".csv"};
  expect_refused(use, user("rec.npy"), "the list of the frames");
  expect_refused({"render", "--sparse", "render {in} --cpu -o {out} --sparse {out}", ".csv"}, user("new.h5"),
                 "twice");
  expect_refused({"bench", "--csv", "bench --quick --paper --cpu --json {out} --csv {out}", ".csv"},
                 user("new"), "twice");
  expect_refused({"simulate", "--truth", "simulate {out}/frames.csv --duration 0.01 --truth {out}", ".csv"},
                 user("sub"), "the list of the pictures");
}

TEST_F(Outputs, StandardInputAndOutputAreFilesToo) {
  const std::string file = recording(300);
  const std::string before = content_of(file);
  EXPECT_EQ(run("convert - --overwrite " + file + " <" + file).exit_code, 2);
  EXPECT_EQ(run("info " + file + " >>" + file).exit_code, 2);
  EXPECT_EQ(run("convert " + file + " - --output-format text >>" + file).exit_code, 2);
  EXPECT_TRUE(content_of(file) == before);
  EXPECT_EQ(
      run("convert " + file + " /dev/stdout --output-format text >" + path("copy") + " 2>" + path("told"))
          .exit_code,
      0);
  EXPECT_TRUE(content_of(path("copy")) == before);
  EXPECT_EQ(run("convert " + file + " /dev/null --output-format evt3").exit_code, 0);
}

// Names that an earlier version used while it wrote belong to the user.
TEST_F(Outputs, TemporaryNamesOfOthersStay) {
  fs::create_directory(path("user"));
  fs::copy_file(recording(300), user("rec.part.txt"));
  write_text(user("out.part.csv"), "precious");
  const Snapshot before = snapshot(path("user"));
  EXPECT_EQ(run("convert " + user("rec.part.txt") + " " + user("rec.txt")).exit_code, 0);
  EXPECT_EQ(run("convert " + user("rec.part.txt") + " " + user("out.csv")).exit_code, 0);
  Snapshot after = snapshot(path("user"));
  EXPECT_EQ(after.erase("rec.txt") + after.erase("out.csv"), 2u);
  EXPECT_EQ(after, before);
}

TEST_F(Outputs, OverwriteReplacesAFileAndKeepsItsPermissions) {
  const std::string file = recording(300);
  write_text(path("out.csv"), "old");
  fs::permissions(path("out.csv"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(run("convert --overwrite " + file + " " + path("out.csv")).exit_code, 0);
  EXPECT_EQ(fs::status(path("out.csv")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(run("convert " + path("out.csv") + " " + path("back.txt")).exit_code, 0);
  EXPECT_EQ(content_of(path("back.txt")), content_of(file));
}

// Each of two is complete or refused, and what is there is one of them.
TEST_F(Outputs, TwoAtOnceNeverMix) {
  fs::copy_file(recording(20'000), path("a.txt"));
  fs::copy_file(recording(30'000), path("b.txt"));
  ASSERT_EQ(run("convert " + path("a.txt") + " " + path("a.csv")).exit_code, 0);
  ASSERT_EQ(run("convert " + path("b.txt") + " " + path("b.csv")).exit_code, 0);
  for (const std::string more : {"", " --overwrite"}) {
    for (int i = 0; i < 5; ++i) {
      const std::string out = path("both.csv");
      fs::remove(out);
      const auto start = [&](const std::string& name) {
        return text("( ", SCARF_PROGRAM, " convert ", path(name + ".txt"), " ", out, more, " >",
                    path(name + ".out"), " 2>&1; echo $? >", path(name + ".rc"), " ) & ");
      };
      ASSERT_EQ(std::system((start("a") + start("b") + "wait").c_str()), 0);
      const bool a = content_of(path("a.rc")) == "0\n";
      const bool b = content_of(path("b.rc")) == "0\n";
      const std::string content = content_of(out);
      EXPECT_TRUE(a || b);
      EXPECT_TRUE((a && content == content_of(path("a.csv"))) || (b && content == content_of(path("b.csv"))));
      if (more.empty()) {
        EXPECT_NE(a, b) << "the later one replaces the earlier one unasked";
      }
    }
  }
}

class Signals : public Outputs, public testing::WithParamInterface<const char*> {};

// What is written when the signal comes goes away, and a shell sees the signal.
TEST_P(Signals, LeaveNothingBehind) {
  fs::create_directory(path("user"));
  fs::copy_file(recording(300), user("rec.txt"));
  const Snapshot before = snapshot(path("user"));
  for (const auto& [signal, number] : {std::pair{"HUP", SIGHUP}, std::pair{"INT", SIGINT},
                                       std::pair{"TERM", SIGTERM}, std::pair{"USR1", SIGUSR1}}) {
    // The recording comes through a pipe that stays open, so that the program waits within it.
    const std::string line =
        text("set -m; mkfifo ", path("pipe"), "; (cat ", user("rec.txt"), "; exec sleep 20) >", path("pipe"),
             " & feeder=$!; ", SCARF_PROGRAM, " ", filled(GetParam(), {{"{user}", path("user")}}), " <",
             path("pipe"), " >", path("told"), " 2>&1 & ", "job=$!; for i in $(seq 200); do [ $(ls -A ",
             path("user"), " | wc -l) -gt 1 ] && break; sleep 0.05; done; ", "sleep 0.1; ls -A ",
             path("user"), " >", path("during"), "; kill -", signal, " $job; wait $job; echo $? >",
             path("rc"), "; kill $feeder; rm ", path("pipe"));
    std::system(text("bash -c '", line, "' 2>/dev/null").c_str());
    EXPECT_EQ(content_of(path("rc")), text(128 + number, "\n")) << signal << content_of(path("told"));
    EXPECT_NE(content_of(path("during")), "rec.txt\n") << "nothing was being written";
    EXPECT_TRUE(snapshot(path("user")) == before) << signal << ": " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Writers, Signals,
    testing::Values("convert - {user}/out.csv", "convert - {user}/out.h5", "convert - {user}/out.npy",
                    "render - --cpu --every 50 -o {user}/out.npy --sparse {user}/out.npz",
                    "render - --cpu --every 50 -o {user}/out.mp4 --sparse {user}/s.h5",
                    "render - --cpu --every 50 -o {user}/new/out/"));

TEST_F(Outputs, ALimitOnTheSizeOfFilesEndsByItsSignal) {
  fs::create_directory(path("user"));
  const std::string line =
      text("ulimit -f 1; exec ", SCARF_PROGRAM, " convert ", recording(20'000), " ", user("out.csv"));
  std::system(text("bash -c '", line, "' >", path("told"), " 2>&1; echo $? >", path("rc")).c_str());
  EXPECT_EQ(content_of(path("rc")), text(128 + SIGXFSZ, "\n"));
  EXPECT_TRUE(fs::is_empty(path("user")));
}

TEST_F(Outputs, SignalsThatAreIgnoredStayIgnored) {
  const std::string line = text("trap \"\" XFSZ; ulimit -f 1; exec ", SCARF_PROGRAM, " convert ",
                                recording(20'000), " ", path("out.csv"));
  std::system(text("bash -c '", line, "' >", path("told"), " 2>&1; echo $? >", path("rc")).c_str());
  EXPECT_EQ(content_of(path("rc")), "1\n");
  EXPECT_THAT(content_of(path("told")), HasSubstr("cannot write"));
  EXPECT_FALSE(fs::exists(path("out.csv")));
}

TEST_F(Outputs, TheSameCommandTwiceMakesTheSameBytes) {
  const std::string file = recording(5'000);
  const std::map<std::string, std::string> lines = {
      {"dsec.h5", "convert " + file + " {out}"},
      {"h5", "render " + file + " --cpu --every 1000 -o {out}"},
      {"tensors.h5", "render " + file + " --cpu --every 1000 --encoding tore -o {out}"},
      {"sparse.h5", "render " + file + " --cpu --every 1000 -o {out}.npy --sparse {out}"},
      {"npz", "render " + file + " --cpu --every 1000 -o {out}.npy --sparse {out}"},
      {"mp4", "render " + file + " --cpu --every 1000 -o {out}"},
  };
  for (const char* time : {"1", "2"}) {
    for (const auto& [name, line] : lines) {
      const std::string zone = *time == '1' ? "TZ=UTC " : "TZ=Asia/Kolkata ";
      const std::string command =
          text(zone, SCARF_PROGRAM, " ", filled(line, {{"{out}", path(text(time, ".", name))}}), " >",
               path("told"), " 2>&1");
      ASSERT_EQ(std::system(command.c_str()), 0) << content_of(path("told"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // times in archives count by two seconds
  }
  for (const auto& [name, line] : lines) {
    EXPECT_TRUE(content_of(path("1." + name)) == content_of(path("2." + name))) << name;
  }
}

// The rule has one place: nothing else in the program makes, renames or removes files.
TEST(OutputRules, OnlyOneComponentTouchesFiles) {
  // The cache of pipelines, which no option names; a bag that is unpacked into a temporary file without a
  // name; what libhdf5 writes through, into a file that the component has made.
  const std::set<std::string> exempt = {"src/io/files/output_files.cpp", "src/io/files/temporaries.cpp",
                                        "src/vulkan/pipeline_cache.cpp", "src/io/ros/rosbag2_reader.cpp",
                                        "src/io/hdf5/file_driver.cpp"};
  const std::vector<std::string> calls = {"ofstream",
                                          "fopen(",
                                          "freopen(",
                                          "fstream>(",
                                          "O_CREAT",
                                          "rename(",
                                          "unlink(",
                                          "rmdir(",
                                          "remove_all(",
                                          "fs::remove(",
                                          "filesystem::remove(",
                                          "std::remove(",
                                          "mkstemp",
                                          "tmpfile",
                                          "copy_file(",
                                          "resize_file(",
                                          "truncate(",
                                          "create_hard_link(",
                                          "create_symlink(",
                                          "cv::imwrite"};
  size_t files = 0;
  for (const char* folder : {"src", "tools", "bench", "include"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SCARF_SOURCE_FOLDER) / folder)) {
      const std::string name = entry.path().lexically_relative(SCARF_SOURCE_FOLDER).generic_string();
      const std::string extension = entry.path().extension().string();
      if ((extension != ".cpp" && extension != ".h") || exempt.contains(name)) continue;
      ++files;
      const std::string content = content_of(entry.path().string());
      for (const std::string& call : calls) {
        EXPECT_EQ(content.find(call), content.npos)
            << name << " has " << call << "; see src/io/files/output_files.h";
      }
    }
  }
  EXPECT_GT(files, 200u);
}

}  // namespace
}  // namespace scarf::tools
