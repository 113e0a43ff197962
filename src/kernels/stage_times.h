// Device times of finished commands, summed by stage.
#pragma once

#include <map>
#include <new>
#include <string>
#include <vector>

#include "scarf/device/tuning.h"
#include "vulkan/commands.h"
#include "vulkan/pool.h"

namespace scarf {

class StageTimes {
 public:
  /// Of commands whose last submission is done. A failure here loses a measurement, not a result.
  void collect(vulkan::Commands& commands) noexcept {
    try {
      const auto spans = commands.take_times();
      if (!spans) return;
      for (const vulkan::StageSpan& span : *spans) {
        const std::string stage(span.stage);
        StageTime& time = times_.try_emplace(stage, StageTime{stage}).first->second;
        time.dispatches += 1;
        time.nanoseconds += span.nanoseconds;
      }
    } catch (const std::bad_alloc&) {
    }
  }
  /// Of those that are idle and done; others are counted when they are used again.
  template <class T>
  void collect_idle(const Pool<T>& pool) {
    for (const auto& object : pool.idle()) {
      const auto done = compute_of(*object).done();
      if (done && *done) collect(compute_of(*object));
    }
  }
  std::vector<StageTime> all() const {
    std::vector<StageTime> times;
    for (const auto& [stage, time] : times_) times.push_back(time);
    return times;
  }

 private:
  std::map<std::string, StageTime> times_;
};

}  // namespace scarf
