// What threads hand each other: the queue between them, and the thread that reads ahead.
#include "session/read_ahead.h"

#include <gtest/gtest.h>

#include <numeric>

#include "session/hand_over.h"
#include "tests/tools/event_fixtures.h"

namespace scarf {
namespace {

using tools::random_events;
using tools::VectorSource;

constexpr SensorSize kSensor{32, 24};

TEST(HandOver, EverythingComesOutOnceAndInOrder) {
  HandOver<int> queue(3);
  std::thread giver([&] {
    for (int i = 0; i < 1000; ++i) ASSERT_TRUE(queue.put(i));
    queue.close();
  });
  std::vector<int> taken;
  while (const auto thing = queue.take()) taken.push_back(*thing);
  giver.join();
  std::vector<int> given(1000);
  std::iota(given.begin(), given.end(), 0);
  EXPECT_EQ(taken, given);
}

TEST(HandOver, WhoWaitsForRoomIsTurnedAwayByTheOtherEnd) {
  HandOver<int> queue(1);
  int dropped = 0;
  std::thread giver([&] {
    while (queue.put(1)) {
    }
    ++dropped;
  });
  EXPECT_EQ(queue.take(), 1);
  queue.abandon();
  giver.join();
  EXPECT_EQ(dropped, 1);
  EXPECT_EQ(queue.take(), std::nullopt);
}

TEST(ReadAhead, GivesWhatTheSourceGivesAndItsReport) {
  const auto events = random_events(300'000, kSensor);
  size_t seen = 0;
  ReadAhead ahead(std::make_unique<VectorSource>(events, kSensor, /*at_once=*/70'001),
                  [&](std::span<const Event> batch) { seen += batch.size(); });
  std::vector<Event> read;
  std::vector<Event> some(7'000);
  while (true) {
    const auto n = ahead.read(some);
    ASSERT_TRUE(n);
    ASSERT_LE(ahead.bytes_read(), ahead.bytes_total());
    if (*n == 0) break;
    read.insert(read.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(*n));
  }
  EXPECT_EQ(read, events);
  EXPECT_EQ(seen, events.size());
  EXPECT_EQ(ahead.report().events, events.size());
}

TEST(ReadAhead, MayBeDroppedWhileItReads) {
  for (size_t n = 0; n < 20; ++n) {
    ReadAhead ahead(std::make_unique<VectorSource>(random_events(2'000, kSensor), kSensor, /*at_once=*/100));
    std::vector<Event> some(50);
    for (size_t i = 0; i < n; ++i) ASSERT_TRUE(ahead.read(some));
  }
}

}  // namespace
}  // namespace scarf
