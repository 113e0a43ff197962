// Recordings that a Python script writes for the tests, from events that it is given in a file.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/little_endian.h"
#include "tests/io/io_test_helpers.h"

namespace scarf {

class PythonRecordings : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  /// What the scripts read: t, x, y and p of each event, 13 bytes, in the file "events".
  void write_events(const std::vector<Event>& events) const {
    Bytes packed;
    for (const Event& e : events) {
      append_little_endian(packed, e.t);
      append_little_endian(packed, e.x);
      append_little_endian(packed, e.y);
      packed.push_back(e.p);
    }
    folder_.add("events", packed);
  }

  /// A script's exit status; kModuleMissing: Python lacks a module.
  int python(const std::string& script, const std::string& what, const std::string& file) const {
    const std::string command =
        std::string(SCARF_SYSTEM_PYTHON " ") + script + " " + what + " " + path("events") + " " + file;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static constexpr int kModuleMissing = 77;

 private:
  const TemporaryFolder folder_;
};

}  // namespace scarf
