// Runs `scarf reprocess` from outside, and looks at what it leaves.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "core/text.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

class ReprocessTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  Outcome shell(const std::string& command) const {
    const int status =
        std::system(text("exec >", path("stdout"), " 2>", path("stderr"), "; ", command).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(path("stdout")),
            content_of(path("stderr"))};
  }
  Outcome run(const std::string& arguments) const {
    return shell(text("exec ", SCARF_PROGRAM, " reprocess ", arguments));
  }
  std::string in_to(const std::string& out, const std::string& more = "--cpu") const {
    return text(path("in"), " -o ", path(out), " ", more);
  }

  static Json json_in(const std::string& file) { return Json::parse(content_of(file), nullptr, false); }
  // Every record below a folder, without what depends on the clock, and on who computed it.
  std::map<std::string, Json> records(const std::string& out, bool with_device = true) const {
    std::map<std::string, Json> found;
    for (const auto& entry : fs::recursive_directory_iterator(path(out))) {
      const std::string name = entry.path().lexically_relative(path(out)).generic_string();
      if (!name.ends_with(".json") || name.starts_with("summary")) continue;
      if (name.find(".tmp/") != name.npos) continue;  // of what a killed run left
      Json json = json_in(entry.path().string());
      EXPECT_TRUE(json.contains("timings")) << name;
      json.erase("timings");
      json.erase("input_state");  // of the file, not of its content
      if (!with_device) json.erase("device");
      found[name] = json;
    }
    return found;
  }
  std::vector<std::string> unfinished(const std::string& out) const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(path(out))) {
      if (entry.path().string().ends_with(".tmp")) found.push_back(entry.path().string());
    }
    return found;
  }

  /// Starts with these arguments twenty times, and kills each start after a random time of up to
  /// `longest_ms`. A record, once there, must stay as it is, and all that it names must be there.
  void kill_twenty_times(const std::string& out, const std::string& arguments, uint64_t longest_ms) const;

 private:
  const TemporaryFolder folder_;
};

inline void ReprocessTest::kill_twenty_times(const std::string& out, const std::string& arguments,
                                             uint64_t longest_ms) const {
  std::mt19937_64 random(7);
  std::map<std::string, ino_t> finished;
  int killed_at_work = 0;
  for (int kill_number = 0; kill_number < 20; ++kill_number) {
    const pid_t child = fork();
    if (child == 0) {
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
      execl("/bin/sh", "sh", "-c", text("exec ", SCARF_PROGRAM, " reprocess ", arguments).c_str(), nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % (longest_ms - 20)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    killed_at_work += WIFSIGNALED(status) ? 1 : 0;
    if (!fs::exists(path(out))) continue;
    for (const auto& [name, record] : records(out)) {
      struct stat file {};
      ASSERT_EQ(stat(path(out + "/" + name).c_str(), &file), 0);
      const auto [at, fresh] = finished.try_emplace(name, file.st_ino);
      EXPECT_EQ(at->second, file.st_ino) << name << " was done again";
      for (const Json& output : record["outputs"]) {
        const std::string place =
            path(out + "/" + record["input"].get<std::string>() + output.get<std::string>());
        EXPECT_TRUE(fs::exists(place)) << place;
        if (place.ends_with('/')) {
          EXPECT_TRUE(fs::exists(place + "frames.csv")) << place;
        }
      }
    }
  }
  EXPECT_GE(killed_at_work, 5) << "the others had finished before";
}

}  // namespace scarf::tools
