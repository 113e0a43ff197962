// The file of compiled pipelines: what is not whole, or not of this user, is as if it were not there.
#include "vulkan/pipeline_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>

#include "tests/support/small_disk.h"

namespace scarf::vulkan {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<uint8_t>;

class PipelineCacheFile : public testing::Test {
 protected:
  PipelineCacheFile()
      : folder_(fs::path(testing::TempDir()) / ("scarf_pipeline_cache_" + std::to_string(getpid()))),
        pipelines_(100'000) {
    fs::create_directories(folder_);
    std::iota(pipelines_.begin(), pipelines_.end(), uint8_t{0});
    alarm(60);  // who waits at a pipe is ended
  }
  ~PipelineCacheFile() override {
    alarm(0);
    fs::remove_all(folder_);
  }
  std::string path(const std::string& name = "a.pipelines") const { return (folder_ / name).string(); }
  Bytes content() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const Bytes& bytes) const {
    std::ofstream(path(), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    chmod(path().c_str(), 0600);
  }

  const fs::path folder_;
  Bytes pipelines_;
};

TEST_F(PipelineCacheFile, ComesBackAsItWasSaved) {
  EXPECT_TRUE(load_pipelines(path()).empty());
  save_pipelines(path("new/folder/a.pipelines"), pipelines_);
  EXPECT_EQ(load_pipelines(path("new/folder/a.pipelines")), pipelines_);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "new/folder"), {}), 1) << "no temporary file";
  save_pipelines(path(), {});
  EXPECT_TRUE(load_pipelines(path()).empty());
}

TEST_F(PipelineCacheFile, IsNothingIfItIsNotWholeOrChanged) {
  save_pipelines(path(), pipelines_);
  const Bytes good = content();
  for (const size_t at :
       {size_t{0}, size_t{7}, size_t{8}, size_t{16}, size_t{23}, size_t{24}, good.size() - 1}) {
    Bytes bad = good;
    bad[at] ^= 1;
    write(bad);
    EXPECT_TRUE(load_pipelines(path()).empty()) << "byte " << at;
    write({good.begin(), good.begin() + static_cast<ptrdiff_t>(at)});
    EXPECT_TRUE(load_pipelines(path()).empty()) << "cut at byte " << at;
  }
  Bytes longer = good;
  longer.push_back(0);
  write(longer);
  EXPECT_TRUE(load_pipelines(path()).empty());
  write(good);
  EXPECT_EQ(load_pipelines(path()), pipelines_);
}

TEST_F(PipelineCacheFile, IsNothingIfOthersCouldHaveWrittenIt) {
  save_pipelines(path(), pipelines_);
  for (const mode_t mode : {0620, 0602, 0666}) {
    chmod(path().c_str(), mode);
    EXPECT_TRUE(load_pipelines(path()).empty()) << std::oct << mode;
  }
  chmod(path().c_str(), 0644);
  EXPECT_EQ(load_pipelines(path()), pipelines_);
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to somebody else";
  ASSERT_EQ(chown(path().c_str(), 12345, 12345), 0);
  EXPECT_TRUE(load_pipelines(path()).empty());
}

TEST_F(PipelineCacheFile, IsNothingIfItIsNoFileOrTooLarge) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(load_pipelines(path("pipe")).empty());
  EXPECT_TRUE(load_pipelines(folder_).empty());
  EXPECT_TRUE(load_pipelines("/dev/zero").empty());
  write({});
  fs::resize_file(path(), uint64_t{1} << 40);  // a hole
  EXPECT_TRUE(load_pipelines(path()).empty());
  save_pipelines("/dev/null/a.pipelines", pipelines_);  // where no folder can be
}

TEST_F(PipelineCacheFile, AFullDiskLeavesTheGoodOne) {
  const test::SmallDisk disk(path("disk"), 1 << 20);
  if (!disk) GTEST_SKIP() << disk.why();
  for (const size_t space : {0, 20'000, 60'000}) {
    disk.leave(300'000);
    const std::string file = disk.folder() + "/a.pipelines";
    save_pipelines(file, pipelines_);
    ASSERT_EQ(load_pipelines(file), pipelines_);
    const auto left = fs::space(disk.folder()).available;
    std::ofstream(disk.folder() + "/more", std::ios::binary) << std::string(left - space, 'x');
    save_pipelines(file, Bytes(pipelines_.size(), 7));
    EXPECT_EQ(load_pipelines(file), pipelines_);
    fs::remove(disk.folder() + "/more");
    EXPECT_EQ(disk.content(), file + " ");
  }
}

}  // namespace
}  // namespace scarf::vulkan
