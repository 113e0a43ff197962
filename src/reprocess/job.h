// The work on one recording, and what became of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reprocess/settings.h"
#include "scarf/core/result.h"

namespace scarf::reprocess {

struct Job {
  std::string relative;  ///< path below the input and below the output, with / between its parts
  std::string path;      ///< of the recording, a file or a folder
  SettingWords settings;
  bool listed = false;  ///< named by a list: it must be a recording
  uint64_t bytes = 0;   ///< of the input, for the time left
};

enum class Status {
  done,       ///< worked through and written
  kept,       ///< finished by an earlier run
  skipped,    ///< no recording, or left out by the recipe
  failed,     ///< the message says why
  left,       ///< not tried, because another one failed before
  identical,  ///< of a check: the reference has the same digests
  differs,    ///< of a check: it has not
};
std::string name_of(Status status);

struct Outcome {
  std::string relative;
  Status status = Status::done;
  std::string message;                    ///< what is to be told: of failed, skipped and differs
  ErrorCode code = ErrorCode::bad_input;  ///< of failed
  uint64_t events = 0;
  uint64_t frames = 0;
  uint64_t bytes = 0;  ///< of the input
  double seconds = 0;
};

/// One thing to do, by any thread of any process.
struct Task {
  enum class Kind { process, check } kind = Kind::process;
  Job job;
};

// Bytes on their way between processes.
std::vector<uint8_t> bytes_of(const Task& task);
std::vector<uint8_t> bytes_of(const Outcome& outcome);
/// Errors: bad_input.
Result<Task> task_from(const std::vector<uint8_t>& bytes);
Result<Outcome> outcome_from(const std::vector<uint8_t>& bytes);

}  // namespace scarf::reprocess
