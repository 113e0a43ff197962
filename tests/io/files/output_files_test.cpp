// What is read, and what others have made, is never written to, replaced or removed.
#include "io/files/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/text.h"
#include "io/files/new_file.h"
#include "scarf/io/recordings.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() : folder_(fs::path(testing::TempDir()) / text("scarf_output_files_", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~OutputFiles() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string user_file(const std::string& name, const std::string& content = "precious") const {
    std::ofstream(path(name)) << content;
    return path(name);
  }
  static std::string content_of(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  size_t entries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  // Writes a whole file; the error if it was refused at any point.
  static Result<void> write(const std::string& file, const OutputRule& rule) {
    auto output = OutputFile::create(file, rule);
    if (!output) return output.error();
    EXPECT_EQ(::write(output->descriptor(), "new", 3), 3);
    return output->publish();
  }
  void expect_refused(const std::string& file, const OutputRule& rule, const std::string& why) const {
    const size_t before = entries();
    const auto written = write(file, rule);
    ASSERT_FALSE(written.ok()) << file;
    EXPECT_EQ(written.error().code, ErrorCode::illegal_parameter) << written.error().message;
    EXPECT_THAT(written.error().message, HasSubstr(file));
    EXPECT_THAT(written.error().message, HasSubstr(why));
    EXPECT_EQ(entries(), before);
  }

 private:
  const fs::path folder_;
};

TEST_F(OutputFiles, AFileThatIsThereIsReplacedOnlyIfAskedForAndKeepsItsPermissions) {
  const std::string file = user_file("a");
  ASSERT_EQ(chmod(file.c_str(), 0640), 0);
  expect_refused(file, OutputRule(), "WriteOptions::overwrite");
  EXPECT_EQ(content_of(file), "precious");
  ASSERT_TRUE(write(file, OutputRule(true)).ok());
  EXPECT_EQ(content_of(file), "new");
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFiles, AnInputIsNeverWrittenToWhateverItsName) {
  const std::string file = user_file("a");
  fs::create_hard_link(file, path("hard"));
  fs::create_symlink(file, path("link"));
  fs::create_directories(path("sub"));
  fs::create_directory_symlink(path(""), path("sub/up"));
  const std::vector<std::string> inputs{file};
  const OutputRule rule(true, inputs);
  for (const std::string name : {"a", "hard", "link", "sub/../a", "sub/up/a"}) {
    expect_refused(path(name), rule, "input");
  }
  EXPECT_EQ(content_of(file), "precious");
}

TEST_F(OutputFiles, WhatIsInAnInputFolderAndBesideADatabaseIsInput) {
  fs::create_directories(path("recording/images"));
  const std::string image = user_file("recording/images/a");
  fs::create_hard_link(image, path("hard"));
  user_file("bag.db3");
  const std::string log = user_file("bag.db3-wal");
  const std::vector<std::string> inputs{path("recording"), path("bag.db3")};
  const OutputRule rule(true, inputs);
  expect_refused(image, rule, "input");
  expect_refused(path("hard"), rule, "input");
  expect_refused(log, rule, "input");
}

TEST_F(OutputFiles, LinksAndFoldersAreRefused) {
  const std::string file = user_file("a");
  fs::create_symlink(file, path("link"));
  fs::create_symlink(path("none"), path("dangling"));
  fs::create_directory(path("folder"));
  for (const bool overwrite : {false, true}) {
    expect_refused(path("link"), OutputRule(overwrite), "symbolic link");
    expect_refused(path("dangling"), OutputRule(overwrite), "symbolic link");
    expect_refused(path("folder"), OutputRule(overwrite), "folder");
  }
  EXPECT_FALSE(fs::exists(path("none")));
  EXPECT_EQ(content_of(file), "precious");
}

TEST_F(OutputFiles, DevicesAndLinksToThemAreWrittenDirectly) {
  fs::create_symlink("/dev/null", path("nowhere"));
  EXPECT_TRUE(write("/dev/null", OutputRule()).ok());
  EXPECT_TRUE(write(path("nowhere"), OutputRule()).ok());
  EXPECT_TRUE(fs::is_symlink(path("nowhere")));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFiles, WhatCameMeanwhileStays) {
  for (const bool input : {false, true}) {
    const std::string file = path(input ? "b" : "a");
    OutputRule rule(input);
    auto output = OutputFile::create(file, rule);
    ASSERT_TRUE(output.ok());
    if (input) {
      rule.add_input(user_file("recording"));
      fs::create_hard_link(path("recording"), file);
    } else {
      user_file("a");
    }
    const auto published = output->publish();
    ASSERT_FALSE(published.ok());
    EXPECT_EQ(published.error().code, ErrorCode::io);
    EXPECT_EQ(content_of(file), "precious");
  }
}

TEST_F(OutputFiles, TemporaryNamesAreUnpredictableAndGoAway) {
  {
    const auto a = OutputFile::create(path("out.csv"), OutputRule());
    const auto b = OutputFile::create(path("out.csv"), OutputRule());
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_NE(a->name(), b->name());
    for (const auto* file : {&*a, &*b}) {
      EXPECT_EQ(fs::path(file->name()).extension(), ".csv");
      EXPECT_TRUE(is_temporary_name(fs::path(file->name()).filename().string())) << file->name();
    }
    EXPECT_EQ(entries(), 2u);
  }
  EXPECT_EQ(entries(), 0u);
  for (const char* name :
       {"out.part.csv", ".a.part", ".a.0123456789abcdeX.part", "a.0123456789abcdef.part"}) {
    EXPECT_FALSE(is_temporary_name(name)) << name;
  }
}

TEST_F(OutputFiles, OutputsOfOneCommandAreDifferentFiles) {
  const OutputRule rule;
  const std::vector<std::string> both{path("a"), path("none/../a")};
  EXPECT_EQ(rule.check(both).ok(), false);
  ASSERT_TRUE(write(path("a"), OutputRule()).ok());
  const OutputRule overwrite(true);
  ASSERT_TRUE(write(path("a"), overwrite).ok());
  expect_refused(path("a"), overwrite, "two outputs");
}

TEST_F(OutputFiles, AFileThatALibraryWasMadeToReplaceIsAnError) {
  auto output = OutputFile::create(path("a"), OutputRule());
  ASSERT_TRUE(output.ok());
  fs::remove(output->name());
  std::ofstream(output->name()) << "of another program";
  EXPECT_FALSE(output->publish().ok());
  EXPECT_FALSE(fs::exists(path("a")));
}

TEST_F(OutputFiles, EveryWayOfNamingLeavesWhatIsThere) {
  for (const Naming naming : {Naming::by_kernel, Naming::by_link, Naming::by_placeholder}) {
    user_file("from", "new");
    const std::string there = user_file("there");
    EXPECT_FALSE(rename_to_free_name(path("from"), there, naming).ok());
    EXPECT_EQ(content_of(there), "precious");
    ASSERT_TRUE(rename_to_free_name(path("from"), path("free"), naming).ok());
    EXPECT_EQ(content_of(path("free")), "new");
    EXPECT_FALSE(fs::exists(path("from")));
    fs::remove(path("free"));

    fs::create_directories(path("folder/inner"));
    EXPECT_FALSE(rename_to_free_name(path("folder"), there, naming).ok());
    ASSERT_TRUE(rename_to_free_name(path("folder"), path("free"), naming).ok()) << static_cast<int>(naming);
    EXPECT_TRUE(fs::exists(path("free/inner")));
    fs::remove_all(path("free"));
  }
}

TEST_F(OutputFiles, FoldersThatWereMadeForNothingGoAway) {
  {
    const auto made = MadeFolder::create(path("a/b/c"));
    ASSERT_TRUE(made.ok());
    EXPECT_TRUE(fs::is_directory(path("a/b/c")));
    const auto scratch = ScratchFolder::create(path("a/b/c/d"));
    ASSERT_TRUE(scratch.ok());
    ASSERT_TRUE(write_new_file(scratch->file("x"), "x").ok());
    EXPECT_FALSE(write_new_file(scratch->file("x"), "y").ok());
    EXPECT_EQ(content_of(scratch->file("x")), "x");
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(OutputFiles, RecordingsKeepTheRule) {
  const std::string file = user_file("a.txt");
  const auto refused = create_events(file, "text", {64, 48});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::illegal_parameter);
  fs::create_hard_link(file, path("hard.txt"));
  EXPECT_FALSE(create_events(path("hard.txt"), "text", {64, 48}, {.overwrite = true, .inputs = {file}}).ok());
  const auto sink = create_events(file, "text", {64, 48}, {.overwrite = true});
  ASSERT_TRUE(sink.ok());
  EXPECT_EQ(content_of(file), "precious") << "until the new one is complete";
  ASSERT_TRUE((*sink)->finish().ok());
  EXPECT_EQ(content_of(file), "64 48\n");
  EXPECT_EQ(content_of(path("hard.txt")), "precious");
}

}  // namespace
}  // namespace scarf
