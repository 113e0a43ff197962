// Files for readers that need a path: one folder per process, in memory where the system has such a place.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace scarf {

class InputFolder {
 public:
  InputFolder() {
    const char* const place = std::getenv("TMPDIR");
    path_ = std::filesystem::path(place != nullptr ? place : "/dev/shm") /
            ("scarf_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  std::string path() const { return path_.string(); }

  /// Writes or replaces a file; its path.
  std::string put(const std::string& name, std::span<const uint8_t> bytes) const {
    const std::string path = (path_ / name).string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace scarf
