#include "session/instants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Property;

constexpr uint64_t kManyFrames = 1'000'000;

// All frames of a stream, whose events are handed over in pieces.
std::vector<Frame> frames_of(Instants& instants, std::span<const Event> events, size_t piece = 3) {
  std::vector<Frame> frames;
  const auto take = [&](const Frame& frame) {
    frames.push_back(frame);
    return Result<void>();
  };
  for (size_t i = 0; i < events.size(); i += piece) {
    const auto r = instants.due(events.subspan(i, std::min(piece, events.size() - i)), take);
    EXPECT_TRUE(r.ok()) << r.error().message;
  }
  EXPECT_TRUE(instants.due_at_end(take).ok());
  return frames;
}

std::vector<Frame> at_rate(const std::string& rate, const std::vector<int64_t>& times) {
  const auto parsed = parse_frame_rate(rate);
  EXPECT_TRUE(parsed.ok());
  return frames_of(*frames_at_rate(*parsed, kManyFrames), events_at(times));
}

TEST(FrameRate, ShowsTheStateBeforeTheFirstEventAtOrAfterTheInstant) {
  // Instants 110, 120, ...: an event at the instant itself is not shown.
  EXPECT_THAT(at_rate("100000", {100, 109, 110, 119, 121}), ElementsAre(Frame{110, 2}, Frame{120, 4}));
}

TEST(FrameRate, EventsOfOneTimeStayTogether) {
  EXPECT_THAT(at_rate("100000", {100, 110, 110, 110, 120}), ElementsAre(Frame{110, 1}, Frame{120, 4}));
}

TEST(FrameRate, AGapMakesManyFramesDue) {
  EXPECT_THAT(at_rate("100000", {100, 135}), ElementsAre(Frame{110, 1}, Frame{120, 1}, Frame{130, 1}));
}

TEST(FrameRate, ABackStepMakesNoFrameDueAgain) {
  EXPECT_THAT(at_rate("100000", {100, 111, 105, 112, 121}), ElementsAre(Frame{110, 1}, Frame{120, 4}));
}

TEST(FrameRate, NothingIsDueWithoutALaterEvent) {
  EXPECT_THAT(at_rate("30", {}), IsEmpty());
  EXPECT_THAT(at_rate("30", {5}), IsEmpty());
  EXPECT_THAT(at_rate("30", {5, 33'337}), IsEmpty());
  EXPECT_THAT(at_rate("30", {5, 33'338}), ElementsAre(Frame{33'338, 1}));
}

TEST(FrameRate, NegativeTimesAreRoundedDownFromTheFirstEvent) {
  EXPECT_THAT(at_rate("30", {-50'000, 20'000}), ElementsAre(Frame{-16'667, 1}, Frame{16'666, 1}));
}

TEST(FrameRate, TheMillionthFrameIsExact) {
  // 29.97 Hz: T_i = floor(i * 1e8 / 2997).
  const auto frames = at_rate("29.97", {0, 100'000'000'000'000 / 2997 + 1});
  ASSERT_EQ(frames.size(), 1'000'000u);
  EXPECT_EQ(frames[0].t, 33'366);
  EXPECT_EQ(frames[2996].t, 100'000'000);
  EXPECT_EQ(frames[999'999].t, 33'366'700'033);
}

TEST(FrameRate, OneGapOfTooManyFramesIsAnErrorBeforeTheFirstOfThem) {
  const std::vector<Event> events = events_at({0, 5, 5'000'000'000'000});
  int taken = 0;
  const auto take = [&](const Frame&) {
    ++taken;
    return Result<void>();
  };
  const auto r = frames_at_rate({30, 1}, 100'000)->due(events, take);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, ErrorCode::bad_input);
  EXPECT_THAT(r.error().message, HasSubstr("FrameRequest::max_frames"));
  EXPECT_THAT(r.error().message, HasSubstr("event 2 (t 5000000000000 us)"));
  EXPECT_EQ(taken, 0);
}

TEST(FrameRate, TheLimitItselfIsAllowed) {
  const std::vector<Event> events = events_at({0, 40});
  const auto take = [](const Frame&) { return Result<void>(); };
  EXPECT_TRUE(frames_at_rate({100'000, 1}, 4)->due(events, take).ok());
  EXPECT_FALSE(frames_at_rate({100'000, 1}, 3)->due(events, take).ok());
}

TEST(FrameRate, ExtremeTimesDoNotOverflow) {
  constexpr int64_t kLowest = std::numeric_limits<int64_t>::min();
  constexpr int64_t kHighest = std::numeric_limits<int64_t>::max();
  EXPECT_THAT(at_rate("0.000001", {kHighest - 5, kHighest}), IsEmpty());
  const auto take = [](const Frame&) { return Result<void>(); };
  const std::vector<Event> events = events_at({kLowest, kHighest});
  EXPECT_FALSE(frames_at_rate({1'000'000, 1}, std::numeric_limits<int64_t>::max())->due(events, take).ok());
}

TEST(FrameRate, OnlyDecimalNumbersInRangeAreLegal) {
  for (const char* word :
       {"", "0", "-1", "1e3", "abc", ".", "30 ", "1000001", "0.0000001", "nan", "99999999"}) {
    const auto rate = parse_frame_rate(word);
    ASSERT_FALSE(rate.ok()) << word;
    EXPECT_EQ(rate.error().code, ErrorCode::illegal_parameter);
  }
  for (const char* word : {"30", "29.97", "0.000001", "1000000", "1000000.000000"}) {
    EXPECT_TRUE(parse_frame_rate(word).ok()) << word;
  }
}

TEST(Every, ShowsTheNthEvent) {
  EXPECT_THAT(frames_of(*frames_every(2), events_at({10, 20, 30, 40, 50})),
              ElementsAre(Frame{20, 2}, Frame{40, 4}));
}

TEST(AtTimes, ShowsTheStateBeforeEachTime) {
  const auto instants = frames_at_times({5, 20, 20, 21, 99});
  EXPECT_THAT(frames_of(*instants, events_at({10, 20, 20, 30})),
              ElementsAre(Frame{5, 0}, Frame{20, 1}, Frame{20, 1}, Frame{21, 3}, Frame{99, 4}));
}

TEST(AtEnd, ShowsTheLastEvent) {
  EXPECT_THAT(frames_of(*frame_at_end(), events_at({10, 20, 30, 40})), ElementsAre(Frame{40, 4}));
  EXPECT_THAT(frames_of(*frame_at_end(), {}), ElementsAre(Frame{0, 0}));
}

TEST(Instants, AnErrorOfTheTakerEndsTheSearch) {
  const std::vector<Event> events = events_at({0, 1'000'000});
  const auto refuse = [](const Frame&) -> Result<void> { return Error{ErrorCode::io, "full"}; };
  std::vector<std::unique_ptr<Instants>> all;
  all.push_back(frames_at_rate({30, 1}, kManyFrames));
  all.push_back(frames_every(1));
  all.push_back(frames_at_times({0}));
  for (const auto& instants : all) {
    const auto r = instants->due(events, refuse);
    ASSERT_FALSE(r.ok());
    EXPECT_EQ(r.error().message, "full");
  }
}

TEST(ReadTimes, TakesOneTimePerLine) {
  const TemporaryFolder folder;
  write_text(folder.path("times"), "-5\r\n10\n\n10\n25");
  const auto times = read_times(folder.path("times"));
  ASSERT_TRUE(times.ok()) << times.error().message;
  EXPECT_THAT(*times, ElementsAre(-5, 10, 10, 25));
}

TEST(ReadTimes, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = folder.path("times");
  const auto error_of = [&](const std::string& content) {
    write_text(path, content);
    const auto times = read_times(path);
    EXPECT_FALSE(times.ok());
    return times.ok() ? Error() : times.error();
  };
  EXPECT_THAT(error_of("1\n2.5x\n").message, HasSubstr("line 2: '2.5x'"));
  EXPECT_THAT(error_of("1\n3\n2\n").message, HasSubstr("line 3: time 2"));
  EXPECT_THAT(error_of("\n").message, HasSubstr("holds no times"));
  EXPECT_EQ(error_of("x").code, ErrorCode::bad_input);
  EXPECT_EQ(read_times(folder.path("missing")).error().code, ErrorCode::io);
}

}  // namespace
}  // namespace scarf::tools
