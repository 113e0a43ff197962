// Files that h5py writes for the tests: real events, re-encoded.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "scarf/io/recordings.h"
#include "tests/io/io_test_helpers.h"
#include "tests/io/python_recordings.h"

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

class Hdf5Test : public PythonRecordings {
 protected:
  void SetUp() override {
    events = sample_events();
    write_events(events);
  }

  /// The exit status of make_hdf5.py.
  int python(const std::string& what, const std::string& file) const {
    return PythonRecordings::python(SCARF_MAKE_HDF5, what, file);
  }

  /// Writes a file in each of these layouts. False: h5py or a filter that they need is not installed.
  bool make(std::initializer_list<const char*> layouts) const {
    for (const std::string layout : layouts) {
      const int status = python(layout, path(layout + ".h5"));
      if (status == kModuleMissing) return false;
      EXPECT_EQ(status, 0) << layout;
    }
    return true;
  }
  static constexpr const char* kMissing = "python3-h5py or an HDF5 filter is not installed";

  /// What is read of a file that make() wrote.
  Recording read(const std::string& layout, const ReadOptions& options = {}) {
    return read_path(path(layout + ".h5"), options, 5000);
  }

  std::vector<Event> events;
};

}  // namespace scarf
