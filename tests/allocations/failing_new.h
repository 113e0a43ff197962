// operator new of this program, which fails on demand: the n-th allocation of a run, or all from it on.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <new>
#include <type_traits>

#include "scarf/core/result.h"

namespace scarf::test {

/// Which allocations fail: one, or all from it on.
enum class Lack { once, from_then_on };

/// Allocations of the thread that calls these. They are counted, and fail, within ours() only.
struct FailingNew {
  /// A new run, in which allocation `n` fails; 0: none does.
  static void plan(uint64_t n, Lack lack);
  static uint64_t count();
  static bool failed();

  /// While one lives, allocations are counted.
  struct Ours {
    Ours();
    ~Ours();
  };
  /// While one lives, they are not: for calls of the driver.
  struct Pause {
    Pause();
    ~Pause();
  };
};

/// Runs a step of scarf's own, of which no exception may come out; its Result.
template <class Step>
auto ours(Step step) -> std::invoke_result_t<Step&> {
  try {
    const FailingNew::Ours counted;
    return step();
  } catch (const std::exception& e) {
    ADD_FAILURE() << "an exception came out: " << e.what();
    return host_out_of_memory();
  }
}

/// As ours(), for what returns no Result: lack of memory may come out.
template <class Step>
void ours_may_throw(Step step) {
  try {
    const FailingNew::Ours counted;
    step();
  } catch (const std::bad_alloc&) {
    EXPECT_TRUE(FailingNew::failed());
  }
}

inline void expect_lack(const Error& error) {
  EXPECT_TRUE(FailingNew::failed()) << error.message;
  EXPECT_EQ(error.code, ErrorCode::out_of_memory) << error.message;
  EXPECT_FALSE(error.message.empty());
}

/// Ends the program if a point takes longer than minutes: a hang is a failure.
void watch(uint64_t n, Lack lack);

/// Every allocation, instead of some; set by hand (see docs/architecture/faults.md).
bool exhaustive();

/// Runs `run` again and again. Each time another allocation fails: every one if exhaustive(), else about
/// `points` of them.
template <class Run>
void fail_each_allocation(Run run, uint64_t points = 24) {
  FailingNew::plan(0, Lack::once);
  watch(0, Lack::once);
  run();
  const uint64_t count = FailingNew::count();
  ASSERT_GT(count, 0u);
  const uint64_t step = exhaustive() || count <= points ? 1 : count / points;
  for (const Lack lack : {Lack::once, Lack::from_then_on}) {
    for (uint64_t n = 1; n <= count && !testing::Test::HasFailure(); n += step) {
      SCOPED_TRACE(testing::Message() << "allocation " << n << " of " << count
                                      << (lack == Lack::once ? "" : " and all behind it"));
      watch(n, lack);
      FailingNew::plan(n, lack);
      run();
    }
  }
  FailingNew::plan(0, Lack::once);
  std::cout << "  " << count << " allocations, every " << step << ". failed\n";
}

}  // namespace scarf::test
