#include "tests/allocations/failing_new.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace scarf::test {
namespace {

constexpr unsigned kSecondsPerPoint = 180;

struct Run {
  uint64_t count = 0;
  uint64_t fail_at = 0;
  Lack lack = Lack::once;
  bool failed = false;
  int ours = 0;
  int paused = 0;

  bool next_fails() {
    if (ours == 0 || paused > 0) return false;
    ++count;
    const bool fails = fail_at != 0 && (lack == Lack::once ? count == fail_at : count >= fail_at);
    failed = failed || fails;
    return fails;
  }
};
thread_local constinit Run t_run;

char g_point[200];  // for the handler of a signal

void say_where(int) {
  const size_t length = std::strlen(g_point);
  if (write(STDERR_FILENO, g_point, length) != static_cast<ssize_t>(length)) std::abort();
  std::abort();
}

}  // namespace

static void* allocate(size_t bytes) {
  if (t_run.next_fails()) throw std::bad_alloc();
  void* const memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void FailingNew::plan(uint64_t n, Lack lack) {
  t_run.count = 0;
  t_run.fail_at = n;
  t_run.lack = lack;
  t_run.failed = false;
}
uint64_t FailingNew::count() {
  return t_run.count;
}
bool FailingNew::failed() {
  return t_run.failed;
}
FailingNew::Ours::Ours() {
  ++t_run.ours;
}
FailingNew::Ours::~Ours() {
  --t_run.ours;
}
FailingNew::Pause::Pause() {
  ++t_run.paused;
}
FailingNew::Pause::~Pause() {
  --t_run.paused;
}

void watch(uint64_t n, Lack lack) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  std::snprintf(g_point, sizeof(g_point), "hang in %s.%s, allocation %llu%s\n", test->test_suite_name(),
                test->name(), static_cast<unsigned long long>(n),
                lack == Lack::once ? "" : " and all behind it");
  std::signal(SIGALRM, say_where);
  alarm(kSecondsPerPoint);
}

bool exhaustive() {
  return std::getenv("SCARF_EVERY_ALLOCATION") != nullptr;
}

}  // namespace scarf::test

// The others of the standard library call these.
void* operator new(size_t bytes) {
  return scarf::test::allocate(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
