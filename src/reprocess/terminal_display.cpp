#include "reprocess/terminal_display.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/text.h"

namespace scarf::reprocess {
namespace {

constexpr std::chrono::milliseconds kOnTerminal(200);
constexpr std::chrono::seconds kInLog(60);
constexpr const char* kClearLine = "\r\033[K";

std::string two_digits(int64_t number) {
  return text(number < 10 ? "0" : "", number);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto s = static_cast<int64_t>(std::llround(seconds));
  if (s >= 3600) return text(s / 3600, " h ", two_digits(s / 60 % 60), " min");
  if (s >= 60) return text(s / 60, " min ", two_digits(s % 60), " s");
  return text(s, " s");
}

TerminalDisplay::TerminalDisplay() : on_terminal_(isatty(STDERR_FILENO) == 1) {}

TerminalDisplay::~TerminalDisplay() {
  if (on_terminal_) std::fputs(kClearLine, stderr);
}

void TerminalDisplay::show(const Standing& s) {
  const auto now = Clock::now();
  if (now - shown_ < (on_terminal_ ? Clock::duration(kOnTerminal) : Clock::duration(kInLog))) return;
  shown_ = now;
  const double done = s.bytes == 0 ? 0 : static_cast<double>(s.bytes_done) / static_cast<double>(s.bytes);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string line = text(s.finished, " of ", s.tasks, " files");
  if (s.failed > 0) line += text(", ", s.failed, " failed");
  line += text(", ", std::lround(100 * done), " % of ", s.bytes / 1'000'000, " MB");
  if (done > 0) line += text(", ", duration_text(seconds * (1 - done) / done), " left");
  std::fprintf(stderr, on_terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
}

void TerminalDisplay::tell(const Outcome& outcome) {
  if (outcome.status != Status::failed && outcome.status != Status::differs) return;
  std::string line = text("scarf: ", outcome.relative, ": ", outcome.message);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  std::fprintf(stderr, "%s%s\n", on_terminal_ ? kClearLine : "", line.c_str());
}

}  // namespace scarf::reprocess
