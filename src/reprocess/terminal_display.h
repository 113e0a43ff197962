// How far a run is, on standard error: a line that is rewritten on a terminal, a line a minute in a log.
// Failures are told as they come.
#pragma once

#include <chrono>

#include "reprocess/run.h"

namespace scarf::reprocess {

class TerminalDisplay final : public Display {
 public:
  TerminalDisplay();
  /// Clears the line.
  ~TerminalDisplay() override;
  TerminalDisplay(const TerminalDisplay&) = delete;
  TerminalDisplay& operator=(const TerminalDisplay&) = delete;

  void show(const Standing& standing) override;
  void tell(const Outcome& outcome) override;

 private:
  using Clock = std::chrono::steady_clock;

  const bool on_terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

/// "2 h 05 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);

}  // namespace scarf::reprocess
