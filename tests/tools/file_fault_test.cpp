// Every file call of a command fails once, whoever makes it: the program, libhdf5, SQLite, OpenCV. Either the
// command says so, or it has done the whole job nevertheless. A few calls of each by default; all of them
// with SCARF_ALL_FILE_FAULTS=1.
#include <cerrno>
#include <cstring>

#include "tests/tools/every_command.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

class FileFaults : public EveryCommand {
 protected:
  struct Fault {
    int error = 0;
    int at = 0;
    bool stays = false;
  };

  Outcome run_with(const Fault& fault, const std::string& command) {
    const std::string environment = text(
        "SCARF_FAULT_FOLDER=", path(""), " SCARF_FAULT_ERROR=", fault.error, " SCARF_FAULT_AT=", fault.at,
        fault.stays ? " SCARF_FAULT_STAYS=1" : "", " SCARF_FAULT_COUNT=", path("count"));
    return run_unchecked(text("env ", environment, " timeout -k 1 120 " SCARF_PROGRAM_WITH_FILE_FAULTS),
                         command);
  }
  int calls_of(int error, const std::string& command) {
    fs::remove(path("count"));
    const Outcome outcome = run_with({error, 0, false}, command);
    EXPECT_EQ(outcome.exit_code, 0) << command << ": " << outcome.err;
    return std::atoi(content_of(path("count")).c_str());
  }
  // All of them, or a few from the first to the last.
  static std::set<int> chosen(int calls) {
    const int step = std::getenv("SCARF_ALL_FILE_FAULTS") != nullptr ? 1 : std::max(1, (calls + 2) / 3);
    std::set<int> numbers;
    for (int n = 1; n <= calls; n += step) numbers.insert(n);
    if (calls > 0) numbers.insert(calls);
    return numbers;
  }
  static std::string describe(const Fault& fault, const std::string& command) {
    return text(command, "\n", std::strerror(fault.error), " at call ", fault.at,
                fault.stays ? " and all behind it\n" : "\n");
  }
};

TEST_F(FileFaults, OfWritersEndInAnErrorOrInTheWholeResult) {
  make_inputs();
  const auto inputs = files_below(path("in"));
  size_t failed = 0;
  for (const std::string& command : writers(path("results"))) {
    // FFmpeg's AVI passes over a single write that fails. That frames are missing is seen, and so is a full
    // disk.
    if (command.find("a.avi") != command.npos) continue;
    const auto fresh = [&] {
      fs::remove_all(path("results"));
      fs::create_directory(path("results"));
    };
    for (const int error : {ENOSPC, EIO}) {
      fresh();
      const int calls = calls_of(error, command);
      const auto whole = files_below(path("results"));
      EXPECT_GT(calls, 0) << command;
      for (const int n : chosen(calls)) {
        // A disk that is full stays so; one call that fails must not be forgotten either.
        const Fault fault{error, n, error == ENOSPC && n % 2 == 0};
        const std::string what = describe(fault, command);
        fresh();
        const Outcome outcome = run_with(fault, command);
        if (outcome.exit_code == 0) {
          EXPECT_EQ(files_below(path("results")), whole) << what;
          EXPECT_EQ(outcome.err, "") << what;
          continue;
        }
        ++failed;
        expect_error(outcome, what, command);
        EXPECT_EQ(left_behind(path("results"), whole), "") << what;
      }
    }
  }
  EXPECT_EQ(files_below(path("in")), inputs) << "inputs are as they were";
  EXPECT_GT(failed, 50u);
}

TEST_F(FileFaults, OfReadersEndInAnErrorOrInTheWholeAnswer) {
  make_inputs();
  const std::string zip =
      text("cd ", path("in/ecd"), " && " SCARF_SYSTEM_PYTHON " -m zipfile -c ../a.zip events.txt");
  ASSERT_EQ(std::system(zip.c_str()), 0);
  std::string packed;
  for (size_t i = 0; i < 500; ++i) {  // what make_bags.py reads
    const Event& e = events_[i];
    packed.append(reinterpret_cast<const char*>(&e.t), 8);
    packed.append(reinterpret_cast<const char*>(&e.x), 2);
    packed.append(reinterpret_cast<const char*>(&e.y), 2);
    packed.push_back(static_cast<char>(e.p));
  }
  write_text(path("packed"), packed);
  const std::string bag =
      text(SCARF_SYSTEM_PYTHON " " SCARF_MAKE_BAGS " rosbag2-mono ", path("packed"), " ", path("in/a.db3"));
  ASSERT_EQ(std::system(bag.c_str()), 0);
  size_t failed = 0;
  for (const std::string& command : readers()) {
    for (const int error : {EIO, EISDIR}) {
      const int calls = calls_of(error, command);
      const std::string answer = content_of(path("out"));
      EXPECT_GT(calls, 0) << command;
      for (const int n : chosen(calls)) {
        const Fault fault{error, n, false};
        const Outcome outcome = run_with(fault, command);
        if (outcome.exit_code == 0) {
          EXPECT_EQ(outcome.out, answer) << describe(fault, command);
          continue;
        }
        ++failed;
        expect_error(outcome, describe(fault, command), command);
      }
    }
  }
  EXPECT_GT(failed, 20u);
}

}  // namespace
}  // namespace scarf::tools
