#include "reprocess/crew.h"

#include <utility>

namespace scarf::reprocess {

Threads::Threads(size_t count, const Workplace& workplace) : workplace_(workplace), meters_(count) {
  for (Meter& meter : meters_) threads_.emplace_back([this, &meter] { work(meter); });
}

Threads::~Threads() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    tasks_.clear();
  }
  task_came_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

size_t Threads::idle() {
  const std::lock_guard lock(mutex_);
  return threads_.size() - at_work_;
}

Result<void> Threads::give(const Task& task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(task);
    ++at_work_;
  }
  task_came_.notify_one();
  return {};
}

Result<std::optional<Outcome>> Threads::wait(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  if (!outcome_came_.wait_for(lock, time, [this] { return !outcomes_.empty(); })) {
    return std::optional<Outcome>();
  }
  std::optional<Outcome> outcome = std::move(outcomes_.front());
  outcomes_.pop_front();
  --at_work_;
  return outcome;
}

uint64_t Threads::bytes_at_work() const {
  uint64_t sum = 0;
  for (const Meter& meter : meters_) sum += meter.bytes;
  return sum;
}

void Threads::work(Meter& meter) {
  while (true) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      task_came_.wait(lock, [this] { return closed_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    Outcome outcome = do_task(task, workplace_, meter);
    meter.bytes = 0;
    {
      const std::lock_guard lock(mutex_);
      outcomes_.push_back(std::move(outcome));
    }
    outcome_came_.notify_one();
  }
}

}  // namespace scarf::reprocess
