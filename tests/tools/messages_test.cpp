// The library speaks of the members of its requests, the program of its options.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "output/frame_request.h"
#include "output/product_request.h"
#include "session/request.h"
#include "tests/tools/program.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// The texts between quotes of a line that is no comment and no include.
std::vector<std::string> literals(const std::string& line) {
  static const std::regex ignored(R"(^\s*(//|#))");
  static const std::regex literal(R"re("((?:[^"\\]|\\.)*)")re");
  std::vector<std::string> found;
  if (std::regex_search(line, ignored)) return found;
  for (auto m = std::sregex_iterator(line.begin(), line.end(), literal); m != std::sregex_iterator(); ++m) {
    found.push_back((*m)[1]);
  }
  return found;
}

// Whether a text names an option or a sub-command of the program. --array is Slurm's.
bool names_an_option(const std::string& words) {
  static const std::regex option(R"((^|[^-\w])--(?!array=)[a-z])");
  static const std::regex command(
      "scarf (bench|compare|convert|cut|devices|digest|formats|frames|info|render|representations|reprocess|"
      "simulate|triggers|verify)");
  return std::regex_search(words, option) || std::regex_search(words, command);
}

// Every text in the sources of the library, with the file it is in.
std::vector<std::pair<std::string, std::string>> texts_of_the_library() {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const char* folder : {"src", "include", "cpu_ref"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SCARF_SOURCE_FOLDER) / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".h") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        for (const std::string& words : literals(line)) {
          texts.emplace_back(entry.path().lexically_relative(SCARF_SOURCE_FOLDER).string(), words);
        }
      }
    }
  }
  return texts;
}

TEST(Messages, TheLookFindsOptionsAndSubCommands) {
  EXPECT_TRUE(names_an_option("give it with --geometry WxH"));
  EXPECT_TRUE(names_an_option("`scarf formats` lists them"));
  EXPECT_FALSE(names_an_option("use --array=0-9"));
  EXPECT_FALSE(names_an_option("ReadOptions::strict"));
  EXPECT_EQ(literals(R"re(  return bad("one", two, "three");)re"),
            (std::vector<std::string>{"one", "three"}));
  EXPECT_TRUE(literals("  // \"--strict\"").empty());
}

TEST(Messages, TheLibraryNamesNoOption) {
  const auto texts = texts_of_the_library();
  EXPECT_GT(texts.size(), 2000u);
  for (const auto& [file, words] : texts) EXPECT_FALSE(names_an_option(words)) << file << ": " << words;
}

TEST(Messages, EveryMemberThatTheLibraryNamesIsAnOption) {
  static const std::regex member(
      R"((ReadOptions|StreamRequest|FrameRequest|ProductRequest|WriteOptions)::\w*)");
  std::set<std::string> members;
  for (const auto& [file, words] : texts_of_the_library()) {
    for (auto m = std::sregex_iterator(words.begin(), words.end(), member); m != std::sregex_iterator();
         ++m) {
      if (m->str().ends_with("::")) continue;  // the member is put behind it
      members.insert(m->str());
    }
  }
  EXPECT_GT(members.size(), 15u);
  for (const std::string& name : members) {
    EXPECT_THAT(in_options("give " + name + ", or not"), Not(HasSubstr("::"))) << name;
  }
}

TEST(Messages, AreOfMembersInTheLibraryAndOfOptionsInTheProgram) {
  EXPECT_EQ(in_options("ReadOptions::time_policy, and ReadOptions::sensor WxH; formats() lists them"),
            "--time-policy, and --geometry WxH; `scarf formats` lists them");
  EXPECT_EQ(in_options("StreamRequest::file"), "file");
  EXPECT_EQ(in_options("ReadOptions::strictly, MyReadOptions::strict"),
            "ReadOptions::strictly, MyReadOptions::strict");
}

using MessagesOfTheProgram = Program;

TEST_F(MessagesOfTheProgram, NameOptions) {
  write_text(path("plain.txt"), "1 2 3 1\n2 3 4 0\n");
  const auto opened = open_events(path("plain.txt"), {});
  ASSERT_FALSE(opened.ok());
  EXPECT_THAT(opened.error().message, HasSubstr("ReadOptions::"));
  const Outcome outcome = run("info " + path("plain.txt"));
  EXPECT_THAT(outcome.err, HasSubstr("--"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("::")));
}

}  // namespace
}  // namespace scarf::tools
