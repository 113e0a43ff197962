// Files that h5py writes for the tests: real events, re-encoded.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "../io_test_helpers.h"
#include "core/little_endian.h"
#include "scarf/io.h"

namespace scarf {

/// Events of a recording if there are some, else made up; ordered in time, within 1280x720.
inline std::vector<Event> sample_events() {
  std::vector<Event> events;
  if (const char* const folder = std::getenv("SCARF_DATA_DIR")) {
    auto source = open_events(std::string(folder) + "/raw/hd_evt3_driving.raw");
    if (source) return read_all(*std::move(source), 4096).events;
  }
  std::mt19937 random(7);
  int64_t t = 11'718'656;
  while (events.size() < 100'000) {
    const auto x = static_cast<uint16_t>(random() % 1270);
    const auto y = static_cast<uint16_t>(random() % 720);
    t += random() % 4 == 0 ? static_cast<int64_t>(random() % 60) : 0;
    // Short rows, as edges give them.
    for (uint16_t i = 0; i < random() % 10; ++i)
      events.push_back({t, static_cast<uint16_t>(x + i), y, static_cast<uint8_t>(random() % 4 > 0)});
  }
  return events;
}

class Hdf5Test : public ::testing::Test {
 protected:
  Hdf5Test()
      : folder_(std::filesystem::path(testing::TempDir()) / ("scarf_hdf5_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Hdf5Test() override { std::filesystem::remove_all(folder_); }

  void SetUp() override {
    events = sample_events();
    std::vector<uint8_t> packed;
    for (const Event& e : events) {
      append_little_endian(packed, e.t);
      append_little_endian(packed, e.x);
      append_little_endian(packed, e.y);
      packed.push_back(e.p);
    }
    std::ofstream(path("events"), std::ios::binary)
        .write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The exit status of make_hdf5.py; 77: h5py or a filter is missing.
  int python(const std::string& what, const std::string& file) const {
    const std::string command =
        std::string(SCARF_SYSTEM_PYTHON " " SCARF_MAKE_HDF5 " ") + what + " " + path("events") + " " + file;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Writes a file in each of these layouts. False: h5py or a filter that they need is not installed.
  bool make(std::initializer_list<const char*> layouts) const {
    for (const std::string layout : layouts) {
      const int status = python(layout, path(layout + ".h5"));
      if (status == 77) return false;
      EXPECT_EQ(status, 0) << layout;
    }
    return true;
  }
  static constexpr const char* kMissing = "python3-h5py or an HDF5 filter is not installed";

  /// What is read of a file that make() wrote.
  Recording read(const std::string& layout, const ReadOptions& options = {}) {
    auto source = open_events(path(layout + ".h5"), options);
    if (!source) return {"", std::nullopt, {}, {}, source.error().message};
    return read_all(*std::move(source), 5000);
  }

  std::vector<Event> events;

 private:
  std::filesystem::path folder_;
};

}  // namespace scarf
