#include "compare/compare_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/lockstep.h"
#include "scarf/reference/reference.h"
#include "tests/tools/altered_scarf.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr SensorSize kSensor{40, 30};
const SideNames kNames{"reference", "device"};

std::unique_ptr<Scarf> make_scarf(Preset preset = Preset::light) {
  return *make_reference_scarf(*make_geometry(preset, kSensor));
}

// A reference and an implementation to be altered, fed with the same events.
struct Sides {
  std::unique_ptr<Scarf> a = make_scarf();
  AlteredScarf b{make_scarf()};

  explicit Sides(size_t events = 500) {
    EXPECT_TRUE(a->push(random_events(events, kSensor)).ok());
    EXPECT_TRUE(b.push(random_events(events, kSensor)).ok());
  }

  std::string difference() {
    const auto d = first_difference(*a, b, kNames);
    EXPECT_TRUE(d.ok());
    return d && *d ? **d : "";
  }
};

TEST(CompareStates, EqualStatesHaveNoDifference) {
  EXPECT_EQ(Sides().difference(), "");
  EXPECT_EQ(Sides(0).difference(), "");
}

TEST(CompareStates, OneFlippedBitOfASlotIsNamed) {
  Sides pair;
  const Snapshot before = *pair.a->snapshot().wait();
  constexpr size_t kPatch = 7;
  constexpr size_t kSlot = 3;
  const Event& slot = before.ring(kPatch)[kSlot];
  ASSERT_LT(kSlot, static_cast<size_t>(before.filled(kPatch)));
  pair.b.alter_snapshot = [](Snapshot& s) { s.slots[kPatch * s.geometry.capacity + kSlot].x ^= 1; };
  const auto shown = [&](int x) {
    return "(t " + std::to_string(slot.t) + ", x " + std::to_string(x) + ", y " + std::to_string(slot.y) +
           ", p " + std::to_string(slot.p) + ")";
  };
  EXPECT_EQ(pair.difference(),
            "patch 7 slot 3: " + shown(slot.x) + " in reference, " + shown(slot.x ^ 1) + " in device");
}

TEST(CompareStates, EveryFieldOfASlotCounts) {
  const std::vector<std::function<void(Event&)>> alterations = {
      [](Event& e) { e.t ^= int64_t{1} << 40; }, [](Event& e) { e.x ^= 1; }, [](Event& e) { e.y ^= 1; },
      [](Event& e) { e.p ^= 1; }};
  for (const auto& alter : alterations) {
    Sides pair;
    pair.b.alter_snapshot = [&](Snapshot& s) { alter(s.slots[2 * s.geometry.capacity]); };
    EXPECT_THAT(pair.difference(), StartsWith("patch 2 slot 0: "));
  }
}

TEST(CompareStates, EmptySlotsCountToo) {
  Sides pair(1);
  const Snapshot before = *pair.a->snapshot().wait();
  const size_t last = before.geometry.capacity - 1;
  pair.b.alter_snapshot = [&](Snapshot& s) { s.slots[last].t = 1; };
  EXPECT_THAT(pair.difference(),
              StartsWith("patch 0 slot " + std::to_string(last) + ": (t 0, x 0, y 0, p 0)"));
}

TEST(CompareStates, TotalsAreNamed) {
  Sides pair;
  const uint64_t total = pair.a->snapshot().wait()->totals[4];
  pair.b.alter_snapshot = [](Snapshot& s) { s.totals[4] += uint64_t{1} << 32; };
  EXPECT_EQ(pair.difference(), "patch 4 total: " + std::to_string(total) + " in reference, " +
                                   std::to_string(total + (uint64_t{1} << 32)) + " in device");
}

TEST(CompareStates, ImagesAreNamedWithPixelAndPlane) {
  Sides counts;
  counts.b.alter_counts = [](Image<int32_t>& i) { i.pixels[2 * 40 + 5] += 7; };
  EXPECT_THAT(counts.difference(), StartsWith("count image (merged) plane 0 pixel 5,2: "));
  Sides separate;
  separate.b.alter_u8 = [](Image<uint8_t>& i) {
    if (i.planes == 2) i.pixels[(30 + 2) * 40 + 5] ^= 0x80;
  };
  EXPECT_THAT(separate.difference(), StartsWith("u8 image (separate) plane 1 pixel 5,2: "));
  Sides floats;
  floats.b.alter_float = [](Image<float>& i) {
    for (float& f : i.pixels) {
      if (f == 0.0f) f = -0.0f;
    }
  };
  EXPECT_THAT(floats.difference(), HasSubstr("0 (bits 0) in reference, -0 (bits 2147483648) in device"));
  Sides size;
  size.b.alter_u8 = [](Image<uint8_t>& i) { i = Image<uint8_t>(39, 30); };
  EXPECT_EQ(size.difference(), "u8 image (merged): 40x30x1 in reference, 39x30x1 in device");
}

TEST(CompareStates, EventListsAreNamed) {
  Sides swapped;
  swapped.b.alter_events = [](std::vector<Event>& e) { std::swap(e[10], e[11]); };
  EXPECT_THAT(swapped.difference(), StartsWith("active events by patch, event 10: "));
  Sides shorter(50);
  shorter.b.alter_events = [](std::vector<Event>& e) { e.pop_back(); };
  EXPECT_THAT(shorter.difference(),
              StartsWith("active events by patch, length: 50 in reference, 49 in device"));
}

TEST(CompareStates, GeometriesAreNamed) {
  const auto a = make_scarf(Preset::light);
  const auto b = make_scarf(Preset::paper);
  const auto d = first_difference(*a, *b, kNames);
  ASSERT_TRUE(d.ok() && *d);
  EXPECT_THAT(**d, HasSubstr("capacity 81 in reference"));
  EXPECT_THAT(**d, HasSubstr("capacity 233 in device"));
}

TEST(Lockstep, ComparesAfterEveryBatch) {
  const auto a = make_scarf();
  const auto b = make_scarf();
  VectorSource source(random_events(1000, kSensor), kSensor);
  const auto run = run_in_lockstep(source, {.batches = BatchSizes::fixed(300)}, *a, *b, kNames);
  ASSERT_TRUE(run.ok());
  EXPECT_FALSE(run->difference.has_value());
  EXPECT_EQ(run->events, 1000u);
  EXPECT_EQ(run->batches, 4u);
  EXPECT_EQ(run->agreed, 1000u);
}

TEST(Lockstep, StopsAtTheFirstBatchThatDiffers) {
  const auto a = make_scarf();
  AlteredScarf b(make_scarf());
  b.alter_snapshot = [snapshots = 0](Snapshot& s) mutable {
    if (++snapshots == 3) s.slots[0].p ^= 1;
  };
  VectorSource source(random_events(1000, kSensor), kSensor);
  const auto run = run_in_lockstep(source, {.batches = BatchSizes::fixed(300)}, *a, b, kNames);
  ASSERT_TRUE(run.ok());
  EXPECT_THAT(run->difference.value_or(""), StartsWith("patch 0 slot 0: "));
  EXPECT_EQ(run->events, 900u);
  EXPECT_EQ(run->batches, 3u);
  EXPECT_EQ(run->agreed, 600u);
}

TEST(Lockstep, PushReportsAreCompared) {
  const auto a = make_scarf();
  AlteredScarf b(make_scarf());
  b.alter_report = [](Result<PushReport> r) {
    r->outside += 1;
    return r;
  };
  VectorSource source(random_events(10, kSensor), kSensor);
  const auto run = run_in_lockstep(source, {}, *a, b, kNames);
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run->difference.value_or(""),
            "push: 10 accepted and 0 outside in reference, 10 accepted and 1 outside in device");
}

TEST(Lockstep, OnlyOneSideRefusingIsADifference) {
  const auto a = make_scarf();
  AlteredScarf b(make_scarf());
  b.alter_report = [](Result<PushReport>) -> Result<PushReport> {
    return Error{ErrorCode::refused_batch, "no"};
  };
  VectorSource source(random_events(10, kSensor), kSensor);
  const auto run = run_in_lockstep(source, {}, *a, b, kNames);
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run->difference.value_or(""), "push: 10 accepted and 0 outside in reference, 'no' in device");
}

TEST(Lockstep, BothSidesRefusingIsAnErrorOfTheInput) {
  const auto a = make_scarf();
  const auto b = make_scarf();
  VectorSource source(events_at({0, int64_t{1} << 60}), kSensor);
  const auto run = run_in_lockstep(source, {}, *a, *b, kNames);
  ASSERT_FALSE(run.ok());
  EXPECT_EQ(run.error().code, ErrorCode::refused_batch);
}

TEST(ShortestFailure, IsFoundWithinTheBatchThatDiffered) {
  const std::vector<Event> events = random_events(1000, kSensor);
  const auto a = make_scarf();
  AlteredScarf b(make_scarf());
  b.alter_snapshot = [](Snapshot& s) {
    if (s.totals[0] >= 20) s.slots[0].p ^= 1;
  };
  // The event with which patch 0 is full of 20 events.
  size_t expected = 0;
  const auto probe = make_scarf();
  while (probe->snapshot().wait()->totals[0] < 20) {
    ASSERT_TRUE(probe->push(std::span(events).subspan(expected++, 1)).ok());
  }

  const PlayOptions options{.batches = BatchSizes::fixed(300)};
  const auto open = [&]() -> Result<std::unique_ptr<EventSource>> {
    return std::unique_ptr<EventSource>(std::make_unique<VectorSource>(events, kSensor));
  };
  auto source = *open();
  auto run = *run_in_lockstep(*source, options, *a, b, kNames);
  ASSERT_GT(run.events, expected);
  const Lockstep shortest = shortest_failure(run, open, options, *a, b, kNames);
  EXPECT_EQ(shortest.events, expected);
  EXPECT_THAT(shortest.difference.value_or(""), StartsWith("patch 0 slot 0: "));
}

TEST(FailingPrefix, FailsAgainWhenItIsPlayed) {
  const TemporaryFolder folder;
  const std::vector<Event> events = random_events(1000, kSensor);
  const auto a = make_scarf();
  AlteredScarf b(make_scarf());
  b.alter_u8 = [&](Image<uint8_t>& image) {
    const auto snapshot = *a->snapshot().wait();
    if (snapshot.totals[0] >= 20) image.pixels[5] ^= 1;
  };
  const auto open = [&]() -> Result<std::unique_ptr<EventSource>> {
    return std::unique_ptr<EventSource>(std::make_unique<VectorSource>(events, kSensor));
  };
  const PlayOptions options{.batches = BatchSizes::fixed(300)};
  const auto run = *run_in_lockstep(**open(), options, *a, b, kNames);
  ASSERT_TRUE(run.difference.has_value());
  const Lockstep failed = shortest_failure(run, open, options, *a, b, kNames);
  ASSERT_LT(failed.events, run.events);

  const std::string path = folder.path("failing.txt");
  ASSERT_TRUE(write_prefix(open, kSensor, failed.events, path, OutputRule()).ok());
  const auto open_prefix = [&] { return open_events(path); };
  std::vector<Event> prefix(events.size());
  prefix.resize(*(*open_prefix())->read(prefix));
  EXPECT_EQ(prefix,
            std::vector<Event>(events.begin(), events.begin() + static_cast<ptrdiff_t>(failed.events)));

  ASSERT_TRUE(a->reset().ok() && b.reset().ok());
  const auto again = *run_in_lockstep(**open_prefix(), options, *a, b, kNames);
  EXPECT_EQ(again.difference, failed.difference);
  EXPECT_EQ(again.events, failed.events);
}

TEST(FailingPrefix, LeavesNoFileWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  const auto no_recording = []() -> Result<std::unique_ptr<EventSource>> {
    return Error{ErrorCode::io, "gone"};
  };
  EXPECT_EQ(write_prefix(no_recording, kSensor, 5, folder.path("a.txt"), OutputRule()).error().message,
            "gone");
  const auto outside = [&]() -> Result<std::unique_ptr<EventSource>> {
    return std::unique_ptr<EventSource>(std::make_unique<VectorSource>(random_events(50, kSensor), kSensor));
  };
  EXPECT_FALSE(write_prefix(outside, {1, 1}, 50, folder.path("a.txt"), OutputRule()).ok());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

TEST(ShortestFailure, OneThatDoesNotComeAgainStaysAsItWas) {
  const auto a = make_scarf();
  const auto b = make_scarf();
  const auto open = [&]() -> Result<std::unique_ptr<EventSource>> {
    return std::unique_ptr<EventSource>(
        std::make_unique<VectorSource>(random_events(1000, kSensor), kSensor));
  };
  const Lockstep failed{.events = 900, .batches = 3, .agreed = 600, .difference = "patch 1 slot 2"};
  const Lockstep shortest =
      shortest_failure(failed, open, {.batches = BatchSizes::fixed(300)}, *a, *b, kNames);
  EXPECT_EQ(shortest.events, 900u);
  EXPECT_EQ(shortest.difference, "patch 1 slot 2");
}

}  // namespace
}  // namespace scarf::tools
