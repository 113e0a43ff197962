#include "session/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace scarf {
namespace {

constexpr std::chrono::milliseconds kInterval(200);
constexpr int kBarWidth = 30;  // characters

}  // namespace

Progress::Progress(const EventSource& source) : source_(source), on_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (on_terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::add(uint64_t events) {
  events_ += events;
  if (!on_terminal_ || Clock::now() - shown_ < kInterval) return;
  shown_ = Clock::now();
  show();
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::show() const {
  const double rate = static_cast<double>(events_) / std::max(seconds(), 1e-9);
  if (source_.bytes_total() == 0) {
    std::fprintf(stderr, "\r\033[K%.2f Mev  %.2f Mev/s", static_cast<double>(events_) / 1e6, rate / 1e6);
  } else {
    const double done = std::clamp(
        static_cast<double>(source_.bytes_read()) / static_cast<double>(source_.bytes_total()), 1e-9, 1.0);
    const auto filled = static_cast<size_t>(done * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %.2f Mev/s  %.0f s left", bar.c_str(), 100 * done,
                 rate / 1e6, seconds() * (1 - done) / done);
  }
  std::fflush(stderr);
}

}  // namespace scarf
