#include "session/play.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/event_fixtures.h"

namespace scarf::tools {
namespace {

using testing::ElementsAre;

constexpr SensorSize kSensor{32, 24};

// What an audience heard: sizes of event spans, and frames as negative event counts.
struct Heard {
  std::vector<int64_t> sequence;
  std::vector<Event> events;

  Audience audience() {
    return {.events =
                [this](std::span<const Event> span) {
                  sequence.push_back(static_cast<int64_t>(span.size()));
                  events.insert(events.end(), span.begin(), span.end());
                  return Result<void>();
                },
            .frame =
                [this](const Frame& frame) {
                  sequence.push_back(-static_cast<int64_t>(frame.events));
                  return Result<void>();
                }};
  }
};

TEST(Play, BatchesAreFullWhateverTheReaderReturns) {
  VectorSource source(random_events(25, kSensor), kSensor, /*at_once=*/3);
  Heard heard;
  const auto played = play(source, {.batches = BatchSizes::fixed(10)}, heard.audience());
  ASSERT_TRUE(played.ok());
  EXPECT_EQ(*played, 25u);
  EXPECT_THAT(heard.sequence, ElementsAre(10, 10, 5));
  EXPECT_EQ(heard.events, random_events(25, kSensor));
}

TEST(Play, FramesCutBatches) {
  VectorSource source(random_events(25, kSensor), kSensor);
  Heard heard;
  const auto instants = frames_every(6);
  ASSERT_TRUE(
      play(source, {.batches = BatchSizes::fixed(10), .instants = instants.get()}, heard.audience()).ok());
  EXPECT_THAT(heard.sequence, ElementsAre(6, -6, 4, 2, -12, 6, -18, 2, 4, -24, 1));
  EXPECT_EQ(heard.events, random_events(25, kSensor));
}

TEST(Play, TheFinalFrameComesAfterAllEvents) {
  VectorSource source(random_events(12, kSensor), kSensor);
  Heard heard;
  const auto instants = frame_at_end();
  ASSERT_TRUE(
      play(source, {.batches = BatchSizes::fixed(10), .instants = instants.get()}, heard.audience()).ok());
  EXPECT_THAT(heard.sequence, ElementsAre(10, 2, -12));
}

TEST(Play, StopsAfterTheMostEvents) {
  VectorSource source(random_events(25, kSensor), kSensor);
  Heard heard;
  EXPECT_EQ(*play(source, {.batches = BatchSizes::fixed(10), .max_events = 14}, heard.audience()), 14u);
  EXPECT_THAT(heard.sequence, ElementsAre(10, 4));
}

TEST(Play, AnErrorOfTheAudienceEndsIt) {
  VectorSource source(random_events(25, kSensor), kSensor);
  int calls = 0;
  const auto refuse = [&](std::span<const Event>) -> Result<void> {
    ++calls;
    return Error{ErrorCode::io, "full"};
  };
  const auto played = play(source, {.batches = BatchSizes::fixed(10)}, {.events = refuse});
  ASSERT_FALSE(played.ok());
  EXPECT_EQ(played.error().message, "full");
  EXPECT_EQ(calls, 1);
}

TEST(BatchSizes, RandomOnesRepeatWithTheirSeed) {
  BatchSizes a = BatchSizes::random(5);
  BatchSizes b = BatchSizes::random(5);
  BatchSizes other = BatchSizes::random(6);
  size_t small = 0;
  size_t large = 0;
  size_t same_as_other = 0;
  for (int i = 0; i < 1000; ++i) {
    const size_t size = a.next();
    ASSERT_EQ(size, b.next());
    ASSERT_GE(size, 1u);
    ASSERT_LE(size, kMaxBatch);
    small += size < 16;
    large += size > 16'384;
    same_as_other += size == other.next();
  }
  EXPECT_GT(small, 100u);
  EXPECT_GT(large, 100u);
  EXPECT_LT(same_as_other, 200u);
}

TEST(BatchSizes, OnlySizesAndRandomAreLegal) {
  for (const char* word : {"1", "131072", "16777216", "random", "random:0", "random:18446744073709551615"}) {
    EXPECT_TRUE(parse_batch_sizes(word).ok()) << word;
  }
  for (const char* word :
       {"", "0", "-1", "16777217", "1.5", "random:", "random:x", "random5", "Random", " 5"}) {
    const auto sizes = parse_batch_sizes(word);
    ASSERT_FALSE(sizes.ok()) << word;
    EXPECT_EQ(sizes.error().code, ErrorCode::illegal_parameter);
  }
  EXPECT_EQ(parse_batch_sizes("77")->next(), 77u);
}

}  // namespace
}  // namespace scarf::tools
