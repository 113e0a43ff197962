// A representation that runs out of memory, and the reference that takes what it took.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <vector>

#include "scarf/core/representation.h"
#include "scarf/device/stream.h"
#include "tests/allocations/failing_new.h"
#include "tests/support/representations.h"

namespace scarf::test {

/// Each step runs with allocations that may fail, and then must hold: what it handed out is the reference's;
/// or it returned out_of_memory, and then the state is what it was before, or the representation says that it
/// is broken, and goes on saying so.
class Followed {
 public:
  /// `exact`: pictures are those of the reference, bit for bit.
  Followed(Representation& tested, Representation& reference, bool exact)
      : tested_(tested), reference_(reference), exact_(exact) {}

  void push(std::span<const Event> events) {
    took(ours([&] { return tested_.push(events); }), events);
  }
  /// What became of a batch that was handed over.
  void took(const Result<PushReport>& report, std::span<const Event> events) {
    if (!report) return failed(report.error());
    EXPECT_FALSE(broken_) << "a broken stream took events";
    const PushReport expected = value_of(reference_.push(events));
    EXPECT_EQ(report->accepted, expected.accepted);
    EXPECT_EQ(report->outside, expected.outside);
  }
  void done(const Result<void>& result) {
    if (!result) failed(result.error());
  }
  void reset() {
    if (const auto result = ours([&] { return tested_.reset(); }); !result) return failed(result.error());
    broken_ = false;
    EXPECT_TRUE(reference_.reset());
  }

  /// `query(representation)` is a Pending.
  template <class Query>
  void ask(Query query, bool compared = true) {
    answered(ours([&] { return query(tested_).wait(); }), query, compared);
  }
  /// Two queries in flight, the first of which is dropped.
  template <class First, class Second>
  void ask_both(First first, Second second, bool compared = true) {
    const auto answer = ours([&] {
      const auto dropped = first(tested_);
      return second(tested_).wait();
    });
    if (!answer) {
      // Of two that change the state, each goes on from where the other ended: perhaps the first alone was
      // done.
      return failed(answer.error(),
                    {[&] { (void)first(reference_).wait(); }, [&] { (void)second(reference_).wait(); }});
    }
    (void)first(reference_).wait();
    answered(answer, second, compared);
  }
  /// The answer of a query.
  template <class Answer, class Query>
  void answered(const Answer& answer, Query query, bool compared = true) {
    const auto of_reference = [&] { return query(reference_).wait(); };
    if (!answer && answer.error().code == ErrorCode::illegal_parameter) {
      EXPECT_FALSE(of_reference()) << answer.error().message;  // keeps no events
      return;
    }
    // The answer may have got lost behind a change that asking makes.
    if (!answer) return failed(answer.error(), {[&] { (void)of_reference(); }});
    EXPECT_FALSE(broken_) << "a broken stream answered";
    const auto expected = of_reference();
    ASSERT_TRUE(expected) << expected.error().message;
    if (compared) {
      EXPECT_TRUE(*answer == *expected) << "the answer is wrong";
    }
  }
  void ask_for_all() {
    ask([](Representation& r) { return r.u8_image(); }, exact_);
    ask([](Representation& r) { return r.float_image(); }, exact_);
    ask([](Representation& r) { return r.raw_image(); }, exact_);
    ask([](Representation& r) { return r.events(); });
    ask([](Representation& r) { return r.state(); });
    if (!value_of(reference_.filter_reports()).empty()) {
      ask([](Representation& r) { return r.filter_reports(); });
    }
  }

  /// With memory again: all goes on.
  void finish(std::span<const Event> events) {
    if (broken_) {
      EXPECT_FALSE(tested_.push({})) << "a broken stream took a batch";
      EXPECT_FALSE(tested_.u8_image().wait()) << "a broken stream gave a picture";
      ASSERT_TRUE(tested_.reset() && reference_.reset());
      broken_ = false;
    }
    EXPECT_TRUE(value_of(tested_.state()) == value_of(reference_.state()));
    ASSERT_TRUE(tested_.push(events) && reference_.push(events));
    EXPECT_TRUE(value_of(tested_.state()) == value_of(reference_.state()));
    if (exact_) {
      EXPECT_TRUE(value_of(tested_.u8_image()) == value_of(reference_.u8_image()));
    }
  }

 private:
  // `otherwise`: what may have been done nevertheless, in this order.
  void failed(const Error& error, const std::vector<std::function<void()>>& otherwise = {}) {
    if (broken_) return;  // as it said
    expect_lack(error);
    const auto state = tested_.state().wait();
    broken_ = !state;
    if (broken_) return;
    for (const auto& done : otherwise) {
      if (*state == value_of(reference_.state())) break;
      done();
    }
    EXPECT_TRUE(*state == value_of(reference_.state())) << "something else was stored than what was reported";
  }

  Representation& tested_;
  Representation& reference_;
  const bool exact_;
  bool broken_ = false;
};

}  // namespace scarf::test
