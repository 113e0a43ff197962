#include "reprocess/run.h"

#include <algorithm>
#include <utility>

namespace scarf::reprocess {
namespace {

constexpr std::chrono::milliseconds kPatience(200);  // between two displays

bool bad(const Outcome& outcome) {
  return outcome.status == Status::failed || outcome.status == Status::differs;
}

}  // namespace

Result<std::vector<Outcome>> run(const std::vector<Task>& tasks, Crew& crew, bool keep_going,
                                 Display& display) {
  std::vector<Outcome> outcomes;
  Standing standing{.tasks = tasks.size()};
  for (const Task& task : tasks) standing.bytes += task.job.bytes;
  uint64_t bytes_finished = 0;
  size_t next = 0;
  bool stopping = false;
  while (true) {
    while (!stopping && next < tasks.size() && crew.idle() > 0) {
      if (auto r = crew.give(tasks[next]); !r) return r.error();
      ++next;
    }
    if (outcomes.size() == next) break;  // nothing is at work, and nothing more is given
    auto outcome = crew.wait(kPatience);
    if (!outcome) return outcome.error();
    if (*outcome) {
      const Outcome& o = **outcome;
      bytes_finished += o.bytes;
      ++standing.finished;
      if (bad(o)) {
        ++standing.failed;
        stopping |= !keep_going || o.code == ErrorCode::device_lost;
      }
      display.tell(o);
      outcomes.push_back(*std::move(*outcome));
    }
    standing.bytes_done = std::min(standing.bytes, bytes_finished + crew.bytes_at_work());
    display.show(standing);
  }
  const auto left = not_tried(std::span(tasks).subspan(next));
  outcomes.insert(outcomes.end(), left.begin(), left.end());
  return outcomes;
}

std::vector<Outcome> not_tried(std::span<const Task> tasks) {
  std::vector<Outcome> outcomes;
  for (const Task& task : tasks) {
    Outcome left;
    left.relative = task.job.relative;
    left.status = Status::left;
    outcomes.push_back(left);
  }
  return outcomes;
}

}  // namespace scarf::reprocess
