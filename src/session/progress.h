// A line on the terminal that tells how far a long job is.
#pragma once

#include <chrono>
#include <cstdint>

#include "scarf/io/recordings.h"

namespace scarf {

/// Shows events per second and the time left on standard error, if that is a terminal; else does nothing.
class Progress {
 public:
  explicit Progress(const EventSource& source);
  /// Clears the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(uint64_t events);
  uint64_t events() const { return events_; }
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  void show() const;

  const EventSource& source_;
  const bool on_terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
  uint64_t events_ = 0;
};

}  // namespace scarf
