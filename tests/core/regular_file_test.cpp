// Files that must be regular ones: nothing else is opened, and nothing is waited for.
#include "core/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace scarf {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class RegularFile : public testing::Test {
 protected:
  RegularFile() : folder_(fs::path(testing::TempDir()) / ("scarf_core_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    alarm(60);  // who waits at a pipe is ended
  }
  ~RegularFile() override {
    alarm(0);
    fs::remove_all(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string error_at(const std::string& name) const {
    const auto content = read_whole(path(name), 100);
    EXPECT_EQ(content.ok(), require_regular(path(name)).ok());
    EXPECT_TRUE(content.ok() || content.error().code == ErrorCode::io);
    return content ? "none" : content.error().message;
  }

 private:
  const fs::path folder_;
};

TEST_F(RegularFile, NothingElseIsOpened) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(error_at("pipe"), HasSubstr("it is a pipe"));
  fs::create_symlink("pipe", path("link"));
  EXPECT_THAT(error_at("link"), HasSubstr("it is a pipe"));
  fs::create_directory(path("folder"));
  EXPECT_THAT(error_at("folder"), HasSubstr("it is a folder"));
  fs::create_symlink("/dev/zero", path("device"));
  EXPECT_THAT(error_at("device"), HasSubstr("it is a device"));
  EXPECT_THAT(error_at("missing"), HasSubstr("No such file"));

  const int made = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(path("socket").size(), sizeof(address.sun_path));
  std::strcpy(address.sun_path, path("socket").c_str());
  ASSERT_EQ(bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_THAT(error_at("socket"), HasSubstr("it is a socket"));
  close(made);
}

TEST_F(RegularFile, IsReadUpToALimit) {
  std::ofstream(path("file")) << std::string(100, 'x');
  EXPECT_EQ(read_whole(path("file"), 100)->size(), 100u);
  EXPECT_EQ(read_whole(path("file"), 99).error().code, ErrorCode::bad_input);
  fs::resize_file(path("file"), uint64_t{1} << 40);  // a hole
  EXPECT_THAT(read_whole(path("file"), 100'000).error().message, HasSubstr("more than 100000 bytes"));
  std::ofstream(path("empty"));
  EXPECT_EQ(*read_whole(path("empty"), 0), "");
}

}  // namespace
}  // namespace scarf
