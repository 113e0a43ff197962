// Gives tasks to a crew until all are done.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reprocess/crew.h"
#include "reprocess/job.h"

namespace scarf::reprocess {

/// How far a run is.
struct Standing {
  size_t tasks = 0;
  size_t finished = 0;
  size_t failed = 0;
  uint64_t bytes = 0;       ///< of all inputs
  uint64_t bytes_done = 0;  ///< of those finished or at work
};

class Display {
 public:
  virtual ~Display() = default;
  virtual void show(const Standing& standing) = 0;
  virtual void tell(const Outcome& outcome) = 0;
};

/// One outcome per task. After a failure only tasks at work are finished, unless `keep_going`; a device that
/// is lost ends the run always, because every other task would fail too. Errors: whatever the crew says.
Result<std::vector<Outcome>> run(const std::vector<Task>& tasks, Crew& crew, bool keep_going,
                                 Display& display);

/// The outcomes of tasks that are not begun.
std::vector<Outcome> not_tried(std::span<const Task> tasks);

}  // namespace scarf::reprocess
