// Those who do tasks: threads of this process, and with MPI those of others.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "reprocess/worker.h"

namespace scarf::reprocess {

class Crew {
 public:
  virtual ~Crew() = default;
  /// How many more tasks would be begun at once.
  virtual size_t idle() = 0;
  /// To be called where idle() is not 0.
  virtual Result<void> give(const Task& task) = 0;
  /// The next outcome, in any order; nullopt if none came within the time.
  virtual Result<std::optional<Outcome>> wait(std::chrono::milliseconds time) = 0;
  /// How much of the tasks at work is done, as far as this process knows.
  virtual uint64_t bytes_at_work() const = 0;
};

/// Threads of this process.
class Threads final : public Crew {
 public:
  Threads(size_t count, const Workplace& workplace);
  /// Waits for what is at work.
  ~Threads() override;
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  size_t idle() override;
  Result<void> give(const Task& task) override;
  Result<std::optional<Outcome>> wait(std::chrono::milliseconds time) override;
  uint64_t bytes_at_work() const override;

 private:
  void work(Meter& meter);

  const Workplace& workplace_;
  std::mutex mutex_;
  std::condition_variable task_came_;
  std::condition_variable outcome_came_;
  std::deque<Task> tasks_;
  std::deque<Outcome> outcomes_;
  size_t at_work_ = 0;  // tasks given whose outcome was not handed out
  bool closed_ = false;
  std::vector<Meter> meters_;  // one per thread
  std::vector<std::thread> threads_;
};

}  // namespace scarf::reprocess
