// Every allocation of readers and writers is made to fail: a recording is read whole or with an error, and an
// output is complete or not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "scarf/io/words.h"
#include "tests/allocations/failing_new.h"
#include "tests/io/io_test_helpers.h"
#include "tests/support/archive_bytes.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::ours;

constexpr SensorSize kSensor = {64, 48};

std::vector<Event> some_events(size_t count) {
  auto events = test::make_stream(test::Spread::uniform, kSensor, count, 1, 1000);
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
  return events;
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const FormatInfo& info : formats()) {
    if (info.written && info.missing.empty()) names.push_back(info.name);
  }
  return names;
}

size_t open_files() {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

Result<void> write_all(const std::string& path, const std::string& format, std::span<const Event> events) {
  auto sink = ours([&] { return create_events(path, format, kSensor, {.overwrite = true}); });
  if (!sink) return sink.error();
  Result<void> first;
  for (size_t at = 0; at < events.size(); at += 700) {
    const auto written =
        ours([&] { return (*sink)->write(events.subspan(at, std::min<size_t>(700, events.size() - at))); });
    if (written && !first) ADD_FAILURE() << "a writer went on after a failure";
    if (!written && first) first = written.error();
  }
  const auto finished = ours([&] { return (*sink)->finish(); });
  if (finished && !first) ADD_FAILURE() << "a writer was finished after a failure";
  if (first && !finished) first = finished.error();
  test::ours_may_throw([&] { sink->reset(); });
  return first;
}

// Reads to the end, and tries to go on after an error. The events, and the first error.
std::pair<std::vector<Event>, Result<void>> read_all_of(const std::string& path, const ReadOptions& options) {
  std::vector<Event> events;
  auto source = ours([&] { return open_events(path, options); });
  if (!source) return {events, source.error()};
  std::vector<Event> some(333);
  Result<void> first;
  for (;;) {
    const auto count = ours([&] { return (*source)->read(some); });
    if (count && !first) {
      ADD_FAILURE() << "a reader went on after a failure";
      break;
    }
    if (!count && !first) break;
    if (!count) {
      first = count.error();
      continue;
    }
    if (*count == 0) break;
    events.insert(events.end(), some.begin(), some.begin() + static_cast<ptrdiff_t>(*count));
  }
  test::ours_may_throw([&] { source->reset(); });
  return {events, first};
}

void fail_while_reading(const std::string& path, const ReadOptions& options = {}, uint64_t points = 60) {
  std::vector<Event> whole;
  test::fail_each_allocation(
      [&] {
        const size_t files = open_files();
        const auto [events, result] = read_all_of(path, options);
        EXPECT_EQ(open_files(), files) << "a file stayed open";
        if (whole.empty()) {
          ASSERT_TRUE(result) << result.error().message;
          whole = events;
        }
        if (!result) test::expect_lack(result.error());
        ASSERT_LE(events.size(), whole.size());
        EXPECT_TRUE(std::equal(events.begin(), events.end(), whole.begin())) << "other events";
        EXPECT_TRUE(!result || events.size() == whole.size()) << "events are missing without a word";
      },
      points);
  EXPECT_FALSE(whole.empty());
}

class FormatLack : public testing::TestWithParam<std::string> {};

TEST_P(FormatLack, WhileWritingLeavesAWholeFileOrNone) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path());
  const std::string path = folder.path() + "/recording." + (GetParam() == "dsec" ? "h5" : "out");
  const auto events = some_events(3000);
  Bytes whole;
  test::fail_each_allocation(
      [&] {
        std::filesystem::remove(path);
        const size_t files = open_files();
        const auto written = write_all(path, GetParam(), events);
        EXPECT_EQ(open_files(), files) << "a file stayed open";
        if (!written) {
          test::expect_lack(written.error());
          EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "a file was left behind";
          return;
        }
        // What HDF5 notes of the time makes files differ, so the events are compared.
        const Recording read = read_path(path);
        EXPECT_EQ(read.error, "");
        EXPECT_TRUE(read.events == events) << read.events.size() << " of " << events.size();
      },
      100);
}

TEST_P(FormatLack, WhileReadingIsAnErrorThatStays) {
  const TemporaryFile file;
  ASSERT_TRUE(write_all(file.path(), GetParam(), some_events(3000)));
  fail_while_reading(file.path());
}

INSTANTIATE_TEST_SUITE_P(Formats, FormatLack, testing::ValuesIn(written_formats()),
                         [](const auto& instance) { return instance.param; });

TEST(ReadingLack, OfArchivesOfArrays) {
  if (const std::string library = missing_library("npz"); !library.empty()) GTEST_SKIP() << library;
  Bytes t, x, y, p;
  for (const Event& e : some_events(2000)) {
    append_little_endian(t, e.t);
    append_little_endian(x, e.x);
    append_little_endian(y, e.y);
    append_little_endian(p, e.p);
  }
  const TemporaryFile file(test::zip_file({{"t.npy", test::npy_file("'<i8'", "(2000,)", t)},
                                           {"x.npy", test::npy_file("'<u2'", "(2000,)", x)},
                                           {"y.npy", test::npy_file("'<u2'", "(2000,)", y)},
                                           {"p.npy", test::npy_file("'|u1'", "(2000,)", p)}}));
  ReadOptions options;
  options.sensor = kSensor;
  options.time_unit = "us";
  fail_while_reading(file.path(), options);
}

TEST(ReadingLack, OfWords) {
  const TemporaryFile file;
  ASSERT_TRUE(write_all(file.path(), "evt3", some_events(3000)));
  Bytes whole;
  test::fail_each_allocation([&] {
    Bytes bytes;
    auto words = ours([&] { return open_words(file.path()); });
    if (!words) return test::expect_lack(words.error());
    Bytes some(1000);
    for (;;) {
      const auto count = ours([&] { return (*words)->read(some); });
      if (!count) {
        test::expect_lack(count.error());
        EXPECT_FALSE((*words)->read(some));
        return;
      }
      if (*count == 0) break;
      bytes.insert(bytes.end(), some.begin(), some.begin() + static_cast<ptrdiff_t>(*count));
    }
    if (whole.empty()) whole = bytes;
    EXPECT_EQ(bytes, whole);
  });
}

}  // namespace
}  // namespace scarf
