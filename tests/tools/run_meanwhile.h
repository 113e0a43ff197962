// Runs the built program, and does something to a file as soon as the program has opened it.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "core/text.h"

namespace scarf::tools {

/// Whether a process has read something of a file that it has open: its place in it is no longer the
/// beginning.
inline bool has_read(const std::filesystem::path& descriptor) {
  std::ifstream info(descriptor.parent_path().parent_path() / "fdinfo" / descriptor.filename());
  std::string word;
  uint64_t place = 0;
  return info >> word >> place && place > 0;
}

/// When a program is met.
enum class Met {
  open,     ///< with the file open
  reading,  ///< with some of it read; not of files that libraries read by other calls than read()
};

/// The exit code of `command` (of a shell, which the program replaces), or -1. The program stands still while
/// `act` is done. What it reads must take it long enough that it is met with the file open.
inline int run_meanwhile(const std::string& command, const std::string& file,
                         const std::function<void()>& act, Met met = Met::open) {
  const pid_t child = fork();
  if (child == 0) {
    setpriority(PRIO_PROCESS, 0, 19);  // it is watched by who has the processor first
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  namespace fs = std::filesystem;
  const fs::path watched = fs::canonical(file);
  const auto is_open = [&] {
    std::error_code error;
    for (fs::directory_iterator fd(text("/proc/", child, "/fd"), error), end; !error && fd != end;
         fd.increment(error)) {
      std::error_code ignored;
      if (fs::read_symlink(fd->path(), ignored) == watched) return met == Met::open || has_read(fd->path());
    }
    return false;
  };
  int status = 0;
  while (!is_open()) {
    if (waitpid(child, &status, WNOHANG) == child) {
      ADD_FAILURE() << "ended before it was seen with " << file << " open: " << command;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  kill(child, SIGSTOP);
  waitpid(child, &status, WUNTRACED);
  EXPECT_TRUE(WIFSTOPPED(status)) << command;
  act();
  kill(child, SIGCONT);
  if (WIFSTOPPED(status)) waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Sets when a file was last written, in seconds since 1970.
inline void set_modified(const std::string& file, time_t seconds) {
  const timespec times[2] = {{seconds, 0}, {seconds, 0}};
  ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0) << file;
}

/// Writes over some bytes of a file, which keeps its size.
inline void write_within(const std::string& file, std::streamoff at, const std::string& bytes) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(at);
  stream << bytes;
  ASSERT_TRUE(stream.good()) << file;
}

}  // namespace scarf::tools
