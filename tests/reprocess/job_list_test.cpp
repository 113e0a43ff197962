#include "reprocess/job_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/text.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::reprocess {

using namespace tools;  // fixtures of the tests of the program
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Listing : public testing::Test {
 protected:
  void add(const std::string& name, const std::string& content = "64 48\n0.1 1 1 1\n") {
    fs::create_directories(fs::path(path(name)).parent_path());
    write_text(path(name), content);
  }
  std::string path(const std::string& name) const { return folder_.path(name); }
  Result<JobList> list(const std::string& input) {
    return list_jobs(path(input), default_recipe(), path("in/out"));
  }
  static std::vector<std::string> names(const JobList& jobs) {
    std::vector<std::string> out;
    for (const Job& job : jobs.jobs) out.push_back(job.relative);
    return out;
  }

  const TemporaryFolder folder_;
};

TEST_F(Listing, OfAFolderHasEveryFileButTheOutput) {
  add("in/b.txt");
  add("in/a/c.txt");
  add("in/out/b.txt.png");
  add("in/half.tmp");
  fs::create_symlink("nowhere", path("in/dangling.raw"));
  fs::create_directory_symlink("..", path("in/a/up"));
  ASSERT_EQ(mkfifo(path("in/pipe").c_str(), 0600), 0);
  const auto jobs = list("in");
  ASSERT_TRUE(jobs.ok()) << jobs.error().message;
  EXPECT_THAT(names(*jobs), ElementsAre("a/c.txt", "b.txt"));
  std::map<std::string, Status> settled;
  for (const Outcome& o : jobs->settled) settled[o.relative] = o.status;
  EXPECT_THAT(settled,
              ElementsAre(std::pair{"a/up", Status::skipped}, std::pair{"dangling.raw", Status::failed},
                          std::pair{"half.tmp", Status::skipped}, std::pair{"pipe", Status::skipped}));
}

TEST_F(Listing, OfTextHasSettingsBehindTabs) {
  add("in/b.txt");
  add("list", "# comment\n\nin/b.txt\tgeometry=64x48\tat=end\r\nin/missing.raw\tas=other/name\n/abs/x.raw\n");
  const auto jobs = list("list");
  ASSERT_TRUE(jobs.ok()) << jobs.error().message;
  EXPECT_THAT(names(*jobs), ElementsAre("abs/x.raw", "in/b.txt", "other/name"));
  EXPECT_EQ(jobs->jobs[1].settings.at("geometry").front(), "64x48");
  EXPECT_EQ(jobs->jobs[1].path, path("in/b.txt"));
  EXPECT_TRUE(jobs->jobs[1].listed);
}

TEST_F(Listing, OfJsonHasSettingsAsMembers) {
  add("list", "{\"path\": \"b.txt\", \"geometry\": \"64x48\", \"output\": [\".png\", \".pgm\"]}\n");
  const auto jobs = list("list");
  ASSERT_TRUE(jobs.ok()) << jobs.error().message;
  EXPECT_THAT(jobs->jobs.front().settings.at("output"), ElementsAre(".png", ".pgm"));
}

TEST_F(Listing, MistakesOfAListNameTheLine) {
  const auto error = [&](const std::string& content) {
    add("list", content);
    const auto jobs = list("list");
    if (jobs) return std::string("no error");
    EXPECT_EQ(jobs.error().code, ErrorCode::illegal_parameter) << jobs.error().message;
    return jobs.error().message;
  };
  EXPECT_THAT(error("a.raw\nb.raw\tgeometry\n"), HasSubstr("line 2"));
  EXPECT_THAT(error("a.raw\tgeometry=x\n"), HasSubstr("line 1"));
  EXPECT_THAT(error("a.raw\tcolour=red\n"), HasSubstr("colour"));
  EXPECT_THAT(error("{\"path\": 3\n"), HasSubstr("line 1"));
  EXPECT_THAT(error("a.raw\tstream=left\na.raw\tstream=right\n"), HasSubstr("as=NAME"));
  EXPECT_THAT(error("a\tas=x.tmp\n"), HasSubstr(".tmp"));
  EXPECT_THAT(error("a\tas=b/c\tgeometry=1x1\nd\toutput=.frames/\tas=b.x\ne\tas=b.x.frames/f\n"),
              HasSubstr("b.x.frames"));
  EXPECT_THAT(error(std::string("EVT\0\1\2", 6)), HasSubstr("neither a folder nor a list"));
  EXPECT_THAT(error(std::string(100'000, 'a')), HasSubstr("neither a folder nor a list"));
  EXPECT_THAT(error("a.raw\n-\n"), HasSubstr("line 2: - is standard input"));
  EXPECT_THAT(error("{\"path\": \"-\"}\n"), HasSubstr("line 1: - is standard input"));
  EXPECT_THAT(error("a.raw\n/dev/zero\n"), HasSubstr("line 2: /dev/zero is neither a file nor a folder"));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(error("pipe\n"), HasSubstr("line 1: pipe is neither a file nor a folder"));
}

TEST_F(Listing, OfLinksThatMultiplyTakesEachFolderOnce) {
  // 24 folders, each with two links to the next: 2^24 ways to the last one.
  for (int i = 0; i < 24; ++i) {
    add(text("in/", i, "/a.txt"));
    const std::string next = text("../", (i + 1) % 24);
    fs::create_directory_symlink(next, path(text("in/", i, "/left")));
    fs::create_directory_symlink(next, path(text("in/", i, "/right")));
  }
  fs::create_directory_symlink("../../in", path("in/5/up"));
  alarm(60);
  const auto jobs = list("in");
  alarm(0);
  ASSERT_TRUE(jobs.ok()) << jobs.error().message;
  EXPECT_EQ(jobs->jobs.size(), 24u);
  EXPECT_EQ(jobs->settled.size(), 49u);
  for (const Outcome& o : jobs->settled) {
    EXPECT_EQ(o.status, Status::skipped) << o.relative;
    EXPECT_THAT(o.message, HasSubstr("the same folder as")) << o.relative;
  }
}

TEST_F(Listing, AFolderKeepsItsOwnNameWhateverLinksSortBeforeIt) {
  add("in/z/a.txt");
  fs::create_directory_symlink("z", path("in/b"));
  add("elsewhere/c.txt");
  fs::create_directory_symlink("../elsewhere", path("in/a"));
  const auto jobs = list("in");
  ASSERT_TRUE(jobs.ok()) << jobs.error().message;
  EXPECT_THAT(names(*jobs), ElementsAre("a/c.txt", "z/a.txt"));
}

}  // namespace
}  // namespace scarf::reprocess
