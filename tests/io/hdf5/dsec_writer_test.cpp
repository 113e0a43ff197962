// The DSEC layout as it is written: read back by us and by h5py.
#include <gmock/gmock.h>

#include "tests/io/hdf5/hdf5_test_helpers.h"
#include "tests/support/small_disk.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr SensorSize kSensor{1280, 720};

// The error of writing, empty if there was none.
std::string written(const std::string& path, std::span<const Event> events, size_t batch) {
  auto sink = create_events(path, "dsec", kSensor, {.overwrite = true});
  if (!sink) return sink.error().message;
  for (; !events.empty(); events = events.subspan(std::min(batch, events.size()))) {
    if (const auto r = (*sink)->write(events.first(std::min(batch, events.size()))); !r)
      return r.error().message;
  }
  const auto finished = (*sink)->finish();
  return finished ? "" : finished.error().message;
}

Recording read_file(const std::string& path) {
  auto source = open_events(path);
  if (!source) return {"", std::nullopt, {}, {}, source.error().message};
  return read_all(*std::move(source), 7777);
}

TEST(DsecWriter, RoundTrip) {
  const TemporaryFile file;
  const auto events = sample_events();
  ASSERT_EQ(written(file.path(), events, 10'001), "");
  const auto r = read_file(file.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "dsec");
  EXPECT_EQ(r.sensor, kSensor);
  EXPECT_EQ(r.events, events);
}

TEST(DsecWriter, AnyOriginAndSilence) {
  const TemporaryFile file;
  const std::vector<Event> events = {{-5, 1, 2, 1}, {-5, 1279, 719, 0}, {(int64_t{1} << 32) - 6, 3, 4, 1}};
  ASSERT_EQ(written(file.path(), events, 2), "");
  EXPECT_EQ(read_file(file.path()).events, events);
  ASSERT_EQ(written(file.path(), {}, 1), "");
  EXPECT_EQ(read_file(file.path()).error, "");
}

TEST(DsecWriter, RefusesWhatTheLayoutCannotHold) {
  const TemporaryFile file;
  std::filesystem::remove(file.path());
  const struct {
    Event event;
    const char* reason;
  } cases[] = {
      {{100 + (int64_t{1} << 32), 1, 1, 1}, "so late a time"},
      {{99, 1, 1, 1}, "sort the events"},
      {{100, 1280, 1, 1}, "outside the sensor"},
      {{100, 1, 1, 2}, "polarity"},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(written(file.path(), std::vector<Event>{{100, 1, 1, 1}, c.event}, 2),
                AllOf(HasSubstr(file.path()), HasSubstr("event 1 "), HasSubstr("dsec"), HasSubstr(c.reason)));
    EXPECT_FALSE(std::filesystem::exists(file.path()));
  }
  EXPECT_THAT(written("/nonexistent/a.h5", {}, 1), HasSubstr("/nonexistent/a.h5"));
  EXPECT_THAT(written("-", {}, 1), HasSubstr("standard output"));
}

class DsecWriterForOthers : public Hdf5Test {};

TEST_F(DsecWriterForOthers, H5pyReadsIt) {
  ASSERT_EQ(written(path("dsec.h5"), events, 4096), "");
  const int status = python("check-dsec", path("dsec.h5"));
  if (status == kModuleMissing) GTEST_SKIP() << kMissing;
  ASSERT_EQ(status, 0);
}

// libhdf5 crashes when a program ends whose files it could not write.
TEST(DsecWriterDeathTest, AFullDiskIsAnErrorAndTheProgramEndsWell) {
  const TemporaryFolder folder;
  const test::SmallDisk disk(folder.path(), 1 << 20);
  if (!disk) GTEST_SKIP() << disk.why();
  const auto events = sample_events();
  const std::string file = folder.path() + "/events.h5";
  for (const size_t space : {0, 20'000, 60'000, 120'000}) {
    disk.leave(space);
    const std::string error = written(file, events, 10'000);
    EXPECT_EQ(error, "cannot write " + file + ": No space left on device");
    EXPECT_EQ(disk.content(), "");
    // Also with a writer that is never destroyed, and one that goes on after the error.
    const auto leave_open = [&] {
      auto created = create_events(file, "dsec", kSensor);
      if (!created) std::exit(0);
      EventSink* const sink = created->release();
      for (size_t at = 0; at + 10'000 <= events.size(); at += 10'000) {
        if (!sink->write(std::span(events).subspan(at, 10'000))) break;
      }
      const auto again = sink->write(std::span(events).last(70'000));
      const auto finished = sink->finish();
      std::exit(!again && !finished ? 0 : 1);
    };
    EXPECT_EXIT(leave_open(), testing::ExitedWithCode(0), "^$");
  }
}

}  // namespace
}  // namespace scarf
