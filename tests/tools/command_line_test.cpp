// What every sub-command does with values that make no sense, whatever its options are.
#include <regex>
#include <set>

#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class CommandLine : public Program {
 protected:
  // The sub-commands that the help lists.
  std::vector<std::string> sub_commands() {
    const std::string help = run("--help").out;
    const std::regex line("\n  ([a-z]+) +[A-Z]");
    std::vector<std::string> names;
    for (std::sregex_iterator i(help.begin() + static_cast<ptrdiff_t>(help.find("Subcommands:")), help.end(),
                                line);
         i != std::sregex_iterator(); ++i) {
      names.push_back((*i)[1]);
    }
    return names;
  }

  // The options of a sub-command that its help lists with a value, long and short ones.
  std::vector<std::string> options_of(const std::string& command) {
    const std::string help = run(command + " --help").out;
    const std::regex line("\n  (-[a-z],)?(--[a-z0-9-]+)(,--[a-z0-9-]+)? [A-Z]+");
    std::vector<std::string> options;
    for (std::sregex_iterator i(help.begin(), help.end(), line); i != std::sregex_iterator(); ++i) {
      for (const int part : {1, 2, 3}) {
        std::string option = (*i)[part];
        if (option.ends_with(',')) option.pop_back();
        if (option.starts_with(',')) option.erase(0, 1);
        if (!option.empty()) options.push_back(option);
      }
    }
    return options;
  }
};

TEST_F(CommandLine, AnEmptyValueIsAnErrorOfEveryOption) {
  size_t options = 0;
  const std::vector<std::string> commands = sub_commands();
  EXPECT_GE(commands.size(), 14u);
  for (const std::string& command : commands) {
    const auto all = options_of(command);
    options += all.size();
    for (size_t i = 0; i < all.size(); ++i) {
      // Each option in one of the ways to give it nothing: the program is slow to start.
      const std::string& option = all[i];
      const std::string given = i % 3 == 0                                ? option + " ''"
                                : i % 3 == 1 || !option.starts_with("--") ? option + " ' '"
                                                                          : option + "=";
      const Outcome outcome = run(command + " file " + given);
      EXPECT_EQ(outcome.exit_code, 2) << command << " " << given;
      EXPECT_THAT(outcome.err, StartsWith("scarf: " + option + " is empty")) << command << " " << given;
    }
  }
  EXPECT_GE(options, 150u) << "the help is not understood";
}

TEST_F(CommandLine, AnEmptyNameIsAnError) {
  const std::string file = recording(100);
  for (const std::string line : {"info ''", "convert '' a", "convert a ''", "'' info a", "digest ' '"}) {
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_THAT(outcome.err, HasSubstr("is empty")) << line;
  }
  // The next argument is not the value of an option that has none.
  EXPECT_EQ(run("digest --cpu --stream= " + file).exit_code, 2);
}

TEST_F(CommandLine, WhatIsNoNumberIsNoNumber) {
  const std::string file = recording(100);
  for (const std::string number : {"2x", "0x2", "nan", "inf", "' 2'"}) {
    for (const std::string option :
         {"--ratio", "--alpha", "--accumulation", "--cell", "--capacity", "--batch", "--window"}) {
      EXPECT_EQ(run("digest --cpu " + file + " " + option + " " + number).exit_code, 2)
          << option << " " << number;
    }
    for (const std::string option : {"--video-fps", "--rate", "--every", "--max-frames"}) {
      EXPECT_EQ(run("render --cpu " + file + " -o " + path("o.mp4") + " " + option + " " + number).exit_code,
                2)
          << option << " " << number;
    }
    for (const std::string option : {"--duration", "--threshold", "--mismatch", "--noise", "--truth-rate",
                                     "--refractory", "--seed", "--hot-pixels"}) {
      EXPECT_EQ(run("simulate " + path("o.raw") + " " + option + " " + number).exit_code, 2)
          << option << " " << number;
    }
    EXPECT_EQ(run("verify " + file + " --bands " + number).exit_code, 2) << number;
  }
}

TEST_F(CommandLine, AnOptionOfOneValueIsGivenOnce) {
  const std::string file = recording(100);
  for (const std::string option :
       {"--alpha 2", "--cell 9", "--geometry 64x48", "--stream a", "--time-policy keep"}) {
    const Outcome outcome = run("digest --cpu " + file + " " + option + " " + option);
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_THAT(outcome.err, HasSubstr(option.substr(0, option.find(' ')))) << option;
  }
}

}  // namespace
}  // namespace scarf::tools
