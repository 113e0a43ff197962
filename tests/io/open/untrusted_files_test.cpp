// Files that are not what their name says, and compute, unpack or wait without end: refused by name, in
// bounded time.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <map>

#include "io/ecd/ecd_files.h"
#include "scarf/io/frames.h"
#include "tests/io/python_recordings.h"

namespace scarf {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class UntrustedFiles : public PythonRecordings {
 protected:
  // Who waits for ever, or works for ever, is ended.
  UntrustedFiles() { alarm(120); }
  ~UntrustedFiles() override { alarm(0); }

  // A pipe in the place of a file, to which nobody writes.
  void pipe(const std::string& name) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0) << name;
  }
  std::string error_of(const std::string& name, const ReadOptions& options = {}) const {
    auto source = open_events(path(name), options);
    return source ? read_all(*std::move(source), 1000).error : source.error().message;
  }
  void add(const std::string& name, std::string_view content) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream(path(name), std::ios::binary) << content;
  }

  const ReadOptions kSensorGiven{SensorSize{346, 260}};
};

TEST_F(UntrustedFiles, PipesInTheFoldersOfRecordingsAreRefusedByName) {
  pipe("bag/metadata.yaml");
  EXPECT_THAT(error_of("bag"), HasSubstr("metadata.yaml: it is a pipe"));
  add("parts/metadata.yaml", "relative_file_paths:\n  - a.db3\n");
  pipe("parts/a.db3");
  EXPECT_THAT(error_of("parts"), HasSubstr("a.db3: it is a pipe"));
  pipe("evimo/dataset_events_p.npy");
  const auto header = [](const std::string& shape) {
    const std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }\n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size()) + '\0' + text;
  };
  add("evimo/dataset_events_t.npy", header("(0,)"));
  add("evimo/dataset_events_xy.npy", header("(0, 2)"));
  EXPECT_THAT(error_of("evimo"), HasSubstr("it is a pipe"));
  pipe("yarp/data.log");
  ReadOptions yarp;
  yarp.format = "yarp";
  EXPECT_THAT(error_of("yarp", yarp), HasSubstr("data.log: it is a pipe"));
  pipe("ecd/events.txt");
  ReadOptions ecd = kSensorGiven;
  ecd.format = "ecd";
  EXPECT_THAT(error_of("ecd", ecd), HasSubstr("events.txt: it is a pipe"));
  add("frames/events.txt", "0.1 1 1 1\n");
  add("frames/images.txt", "0.1 image.png\n");
  pipe("frames/image.png");
  const auto frames = open_frames(path("frames"));
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  EXPECT_THAT((*frames)->read().error().message, HasSubstr("image.png: it is a pipe"));
}

// Of a million bytes an archive has gigabytes of them.
TEST_F(UntrustedFiles, TextWithoutEventsEnds) {
  for (const std::string_view line : {"\n", "# nothing\n", "word\n", " \r\n"}) {
    for (const size_t step : {ByteReader::kCapacity, size_t{65'537}}) {
      const auto endless = [line, at = size_t{0}, begun = false,
                            step](std::span<uint8_t> out) mutable -> Result<size_t> {
        constexpr std::string_view kStart = "64 48\n0.5 1 2 1\n";
        if (!begun) {
          begun = true;
          std::copy(kStart.begin(), kStart.end(), out.begin());
          return kStart.size();
        }
        const size_t count = std::min(out.size(), step);
        for (size_t i = 0; i < count; ++i) out[i] = static_cast<uint8_t>(line[at++ % line.size()]);
        return count;
      };
      const Recording r = read_all(ByteReader(endless, 0));
      EXPECT_THAT(r.error, HasSubstr("lines in a row hold no event")) << line;
      EXPECT_EQ(r.events.size(), 1u) << line;
      if (line != "\n") break;  // the others take a while
    }
  }
}

TEST_F(UntrustedFiles, EmptyLinesBetweenEventsAreNoMatter) {
  const std::string gap(100'000, '\n');
  const Bytes bytes = bytes_of("64 48\n0.1 1 2 1\n" + gap + "0.2 3 4 0\r\n" + gap + "\n0.3 5 6 1");
  const Recording r = read_all(bytes);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.events, (std::vector<Event>{{100'000, 1, 2, 1}, {200'000, 3, 4, 0}, {300'000, 5, 6, 1}}));
  EXPECT_EQ(r.report.unknown_words, 0u);
}

TEST_F(UntrustedFiles, AListOfImagesEnds) {
  add("ecd/events.txt", "0.1 1 1 1\n");
  add("ecd/images.txt", std::string(3'000'000, '\n'));
  EXPECT_THAT(error_of("ecd"), HasSubstr("images.txt: the 1000000 lines"));
}

TEST_F(UntrustedFiles, MetadataHasALimit) {
  add("bag/metadata.yaml", "relative_file_paths:\n");
  fs::resize_file(path("bag/metadata.yaml"), uint64_t{1} << 40);  // a hole
  EXPECT_THAT(error_of("bag"), HasSubstr("metadata.yaml: it has more than"));
}

class UntrustedDatabases : public UntrustedFiles {
 protected:
  void SetUp() override {
    if (const std::string missing = missing_library("rosbag2"); !missing.empty()) GTEST_SKIP() << missing;
    for (int i = 0; i < 500; ++i) {
      events_.push_back(
          {1000 + 7 * i, static_cast<uint16_t>(i % 300), static_cast<uint16_t>(i % 200), uint8_t(i % 2)});
    }
    write_events(events_);
  }
  void make(const std::string& kind) const {
    ASSERT_EQ(python(SCARF_MAKE_DATABASES, kind, path(kind + ".db3")), 0) << kind;
  }
  // Names of a folder, with sizes and times.
  std::map<std::string, std::pair<uint64_t, fs::file_time_type>> beside(const std::string& name) const {
    std::map<std::string, std::pair<uint64_t, fs::file_time_type>> found;
    for (const auto& entry : fs::directory_iterator(fs::path(path(name)).parent_path())) {
      found[entry.path().filename()] = {entry.file_size(), entry.last_write_time()};
    }
    return found;
  }

  std::vector<Event> events_;
};

TEST_F(UntrustedDatabases, ComputeNothing) {
  const std::map<std::string, std::string> reasons = {{"computed-data", "computes messages.data"},
                                                      {"computed-type", "computes topics.type"},
                                                      {"view", "SQLite cannot find the messages"},
                                                      {"virtual", "SQLite cannot find the messages"}};
  for (const auto& [kind, reason] : reasons) {
    make(kind);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(error_of(kind + ".db3"), HasSubstr(reason)) << kind;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << kind;
  }
}

TEST_F(UntrustedDatabases, GiveNoMoreThanTheyHave) {
  make("shared-pages");
  auto source = open_events(path("shared-pages.db3"));
  ASSERT_TRUE(source.ok()) << source.error().message;
  const Recording r = read_all(*std::move(source), 1000);
  EXPECT_GE(r.report.damages, 1u);
  EXPECT_LE(r.report.damages, 3u) << "20 rows of a million bytes are in a file of 1.4 million";
}

TEST_F(UntrustedDatabases, LeaveNothingBesideThem) {
  for (const std::string kind : {"wal-none", "wal-alone", "wal-shared"}) {
    make(kind);
    const auto before = beside(kind + ".db3");
    auto source = open_events(path(kind + ".db3"), kSensorGiven);
    ASSERT_TRUE(source.ok()) << source.error().message;
    const Recording r = read_all(*std::move(source), 100);
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.events, events_) << kind << ": those not yet moved into the database are read, too";
    const auto after = beside(kind + ".db3");
    EXPECT_EQ(after.size(), before.size()) << kind;
    for (const auto& [name, facts] : before) {
      ASSERT_EQ(after.count(name), 1u) << name;
      EXPECT_EQ(after.at(name).first, facts.first) << name;
      if (!name.ends_with("-shm")) {
        EXPECT_EQ(after.at(name).second, facts.second) << name;
      }
    }
  }
}

TEST_F(UntrustedDatabases, JournalsThatArePipesAreRefusedByName) {
  for (const std::string suffix : {"-journal", "-wal", "-shm"}) {
    const std::string name = "a" + suffix + ".db3";
    ASSERT_EQ(python(SCARF_MAKE_BAGS, "rosbag2-mono", path(name)), 0);
    pipe(name + suffix);
    EXPECT_THAT(error_of(name), HasSubstr(suffix + ": it is a pipe"));
  }
}

}  // namespace
}  // namespace scarf
