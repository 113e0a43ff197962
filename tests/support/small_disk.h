// A disk that is soon full.
#pragma once

#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace scarf::test {

/// A file system in memory, of so many bytes. Only root can mount one; elsewhere a test is skipped with
/// why().
class SmallDisk {
 public:
  SmallDisk(std::string folder, size_t bytes) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    const std::string size = "size=" + std::to_string(bytes);
    mounted_ = mount("scarf_test", folder_.c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (!mounted_) why_ = std::string("no small disk can be mounted: ") + std::strerror(errno);
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  explicit operator bool() const { return mounted_; }
  const std::string& why() const { return why_; }
  const std::string& folder() const { return folder_; }

  /// Fills it but for so many bytes; what else is on it is removed.
  void leave(size_t bytes) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      std::filesystem::remove_all(entry.path());
    }
    const auto free = std::filesystem::space(folder_).available;
    if (free <= bytes) return;
    const std::string content(free - bytes, 'x');
    std::ofstream(folder_ + "/" + kFiller, std::ios::binary) << content;
  }
  /// Files and folders on it, but for what fills it.
  std::string content() const {
    std::string names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.path().filename() != kFiller) names += entry.path().string() + " ";
    }
    return names;
  }

  static constexpr const char* kFiller = "filler";

 private:
  std::string folder_;
  bool mounted_ = false;
  std::string why_;
};

}  // namespace scarf::test
