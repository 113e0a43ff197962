// Recordings whose files change while they are read: an error says so, whatever the format and the change.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <functional>
#include <thread>

#include "io/base/input_files.h"
#include "io/files/file_state.h"
#include "scarf/io/frames.h"
#include "scarf/io/words.h"
#include "tests/io/python_recordings.h"
#include "tests/support/archive_bytes.h"

namespace scarf {
namespace {

using test::npy_file;
using test::png_file;
using test::zip_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

constexpr SensorSize kSensor{32, 24};
constexpr int64_t kSecond = 1'000'000'000;
constexpr int64_t kLongAgo = 1'600'000'000 * kSecond;  // so that no change has the same time by chance

// --- What happens to files.
// ----------------------------------------------------------------------------------------

void set_modified(const std::string& file, int64_t ns) {
  const timespec time{static_cast<time_t>(ns / kSecond), static_cast<long>(ns % kSecond)};
  const timespec times[2] = {time, time};
  ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0) << file;
}

void overwrite_last_byte(const std::string& file, uint8_t change) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(-1, std::ios::end);
  const int last = stream.get();
  stream.seekp(-1, std::ios::end);
  stream.put(static_cast<char>(last ^ change));
  ASSERT_TRUE(stream.good()) << file;
}

void grow(const std::string& file) {
  std::ofstream(file, std::ios::binary | std::ios::app) << "grows";
}
void shrink(const std::string& file) {
  fs::resize_file(file, fs::file_size(file) / 2);
}
void shrink_to_nothing(const std::string& file) {
  fs::resize_file(file, 0);
}
// By a file of the same content and times: it is another one.
void replace(const std::string& file) {
  const std::string other = file + ".other";
  fs::copy_file(file, other);
  set_modified(other, kLongAgo);
  fs::rename(other, file);
}
void write_again(const std::string& file) {
  overwrite_last_byte(file, 1);
}
void write_the_same_again(const std::string& file) {
  overwrite_last_byte(file, 0);
}
void set_a_later_time(const std::string& file) {
  set_modified(file, kLongAgo + 1);  // a nanosecond
}
void set_an_earlier_time(const std::string& file) {
  set_modified(file, kLongAgo - kSecond);
}
void remove(const std::string& file) {
  fs::remove(file);
}

struct Change {
  const char* name;
  void (*make)(const std::string& file);
  const char* told;
};
const Change kChanges[] = {
    {"grow", grow, "bytes"},
    {"shrink", shrink, "bytes"},
    {"shrink_to_nothing", shrink_to_nothing, "-> 0 bytes"},
    {"replace", replace, "another file"},
    {"write_again", write_again, "time of modification"},
    {"write_the_same_again", write_the_same_again, "time of modification"},
    {"set_a_later_time", set_a_later_time, "time of modification"},
    {"set_an_earlier_time", set_an_earlier_time, "time of modification"},
    {"remove", remove, "no longer there"},
};

void change_rights(const std::string& file) {
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(file, fs::perms::owner_read);
}
void add_a_link(const std::string& file) {
  fs::create_hard_link(file, file + ".link");
}
void rename_and_back(const std::string& file) {
  fs::rename(file, file + ".elsewhere");
  fs::rename(file + ".elsewhere", file);
}
void set_the_same_time(const std::string& file) {
  set_modified(file, kLongAgo);
}
void read_it(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
}

// What leaves the content as it is.
const Change kHarmless[] = {
    {"change_rights", change_rights, ""},
    {"add_a_link", add_a_link, ""},
    {"rename_and_back", rename_and_back, ""},
    {"set_the_same_time", set_the_same_time, ""},
    {"read_it", read_it, ""},
};

// --- Recordings of all formats.
// ------------------------------------------------------------------------------------

struct Kind {
  std::string name;                ///< of the folder with its files
  std::string opened;              ///< within that
  std::vector<std::string> files;  ///< within that; what is read
  ReadOptions options;
  bool by_library = false;  ///< a library reads the file: its bytes do not pass our hands
};

class ChangingFiles : public PythonRecordings {
 protected:
  ChangingFiles() : kinds_(make_all()) {
    for (const auto& entry : fs::recursive_directory_iterator(path("whole"))) {
      if (entry.is_regular_file()) set_modified(entry.path().string(), kLongAgo);
    }
  }

  // A copy of a recording to be changed.
  std::string fresh(const Kind& kind) const {
    const std::string folder = path("fresh");
    fs::remove_all(folder);
    fs::copy(path("whole/" + kind.name), folder, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) set_modified(entry.path().string(), kLongAgo);
    }
    return kind.opened.empty() ? folder : folder + "/" + kind.opened;
  }
  std::string in_fresh(const std::string& file) const { return path("fresh/" + file); }

  static ReadOptions with_sensor() {
    ReadOptions options;
    options.sensor = kSensor;
    return options;
  }

  const std::vector<Event>& events() const { return events_; }
  const std::vector<Kind>& kinds() const { return kinds_; }

 private:
  std::vector<Kind> make_all();
  void add(const std::string& file, const Bytes& content) const { whole_.add(file, content); }
  static std::vector<Event> some_events() {
    std::vector<Event> events;
    for (int64_t i = 0; i < 5000; ++i) {
      events.push_back({1'000'000 + 10 * i, static_cast<uint16_t>(i % 32), static_cast<uint16_t>(i % 24),
                        static_cast<uint8_t>(i % 2)});
    }
    return events;
  }

  struct Whole {  // below the folder of PythonRecordings
    std::string root;
    void add(const std::string& name, const Bytes& content) const {
      const fs::path file = fs::path(root) / name;
      fs::create_directories(file.parent_path());
      std::ofstream(file, std::ios::binary)
          .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    }
  };

  const std::vector<Event> events_ = some_events();
  const Whole whole_{path("whole")};
  std::vector<Kind> kinds_;
};

std::vector<Kind> ChangingFiles::make_all() {
  std::vector<Kind> kinds;
  // Every format that is written.
  for (const FormatInfo& format : formats()) {
    if (!format.written || !format.missing.empty()) continue;
    fs::create_directories(path("whole/" + format.name));
    const std::string file = path("whole/" + format.name + "/rec");
    auto sink = create_events(file, format.name, kSensor);
    EXPECT_TRUE(sink.ok() && (*sink)->write(events_).ok() && (*sink)->finish().ok()) << format.name;
    ReadOptions options = with_sensor();
    options.format = format.name;
    kinds.push_back({format.name, "rec", {"rec"}, options, format.name == "dsec"});
  }

  Bytes words;
  Bytes seconds;
  Bytes places;
  Bytes polarities;
  Bytes rows;
  std::string lines;
  std::string log;
  for (const Event& e : events_) {
    const auto t = static_cast<uint32_t>(e.t & 0x7FFFFF);
    for (const uint32_t byte : {uint32_t{e.x}, uint32_t{e.y}, e.p << 7 | t >> 16, t >> 8, t}) {
      words.push_back(static_cast<uint8_t>(byte));
    }
    append_little_endian(seconds, std::bit_cast<uint64_t>(static_cast<double>(e.t) * 1e-6));
    append_little_endian(places, e.x);
    append_little_endian(places, e.y);
    polarities.push_back(e.p);
    for (const int64_t number : {e.t, int64_t{e.x}, int64_t{e.y}, int64_t{e.p}}) {
      append_little_endian(rows, number);
    }
    lines += "1.5 " + std::to_string(e.x) + " " + std::to_string(e.y) + " 1\n";
    log += "7 1.5 AE (" + std::to_string(25 + e.t % 1000) + " " +
           std::to_string(uint32_t{e.y} << 12 | uint32_t{e.x} << 1) + ")\n";
  }
  const std::string count = std::to_string(events_.size());
  add("nmnist/rec", words);
  ReadOptions nmnist = with_sensor();
  nmnist.format = "nmnist";
  kinds.push_back({"nmnist", "rec", {"rec"}, nmnist});

  add("evimo2/dataset_events_t.npy", npy_file("'<f8'", "(" + count + ",)", seconds));
  add("evimo2/dataset_events_xy.npy", npy_file("'<u2'", "(" + count + ", 2)", places));
  add("evimo2/dataset_events_p.npy", npy_file("'|u1'", "(" + count + ",)", polarities));
  kinds.push_back({"evimo2",
                   "",
                   {"dataset_events_t.npy", "dataset_events_xy.npy", "dataset_events_p.npy"},
                   with_sensor()});

  const Bytes image = png_file(32, 24, Bytes(size_t{32} * 24, 100));
  const Bytes list = bytes_of("0.6 images/a.png\n0.7 images/b.png\n");
  add("ecd/events.txt", bytes_of(lines));
  add("ecd/images.txt", list);
  add("ecd/images/a.png", image);
  add("ecd/images/b.png", image);
  kinds.push_back({"ecd", "", {"events.txt", "images.txt", "images/a.png"}, with_sensor()});

  add("yarp/data.log", bytes_of(log));
  add("yarp/info.log", bytes_of("Type: Bottle;\n"));
  kinds.push_back({"yarp", "", {"data.log"}, with_sensor()});
  add("yarp_file/rec.log", bytes_of(log));
  kinds.push_back({"yarp_file", "rec.log", {"rec.log"}, with_sensor()});

  const auto missing = [](std::string_view format) { return !missing_library(format).empty(); };
  if (!missing("npz")) {
    add("npz/rec.npz", zip_file({{"events.npy", npy_file("'<i8'", "(" + count + ", 4)", rows)}}));
    kinds.push_back({"npz", "rec.npz", {"rec.npz"}, with_sensor(), true});
    add("ecd_zip/rec.zip",
        zip_file({{"events.txt", bytes_of(lines)}, {"images.txt", list}, {"images/a.png", image}}));
    kinds.push_back({"ecd_zip", "rec.zip", {"rec.zip"}, with_sensor(), true});
  }

  write_events(events_);
  const struct {
    std::string kind, format;
    std::vector<std::string> files;  // of a folder
    bool by_library;
  } bags[] = {
      {"rosbag-dvs-none", "rosbag", {}, false},
      {"mcap", "mcap", {}, false},
      {"aedat4-none-1", "aedat4", {}, false},
      {"rosbag2-mono", "rosbag2", {}, true},
      {"rosbag2-folder", "rosbag2", {"metadata.yaml", "z_0.db3", "a_1.db3"}, true},
  };
  for (const auto& bag : bags) {
    if (missing(bag.format)) continue;
    const bool folder = !bag.files.empty();
    if (!folder) fs::create_directories(path("whole/" + bag.kind));
    const std::string place = path("whole/" + bag.kind + (folder ? "" : "/rec"));
    if (python(SCARF_MAKE_BAGS, bag.kind, place) != 0) continue;  // a module is missing
    kinds.push_back({bag.kind, folder ? "" : "rec", folder ? bag.files : std::vector<std::string>{"rec"},
                     ReadOptions{}, bag.by_library});
  }
  return kinds;
}

// When a file changes.
enum class When { before_the_first_event, after_the_first_event, after_the_last_event };

struct Ended {
  size_t events = 0;
  std::string error;
  ErrorCode code = ErrorCode::io;
};

// Reads a recording, and does something meanwhile; `count`: its events.
Ended read_meanwhile(const std::string& path, const ReadOptions& options, When when, size_t count,
                     const std::function<void()>& change) {
  const auto source = open_events(path, options);
  if (!source) return {0, source.error().message, source.error().code};
  Ended ended;
  const size_t until = when == When::before_the_first_event  ? 0
                       : when == When::after_the_first_event ? 1
                                                             : count;
  bool changed = false;
  std::vector<Event> buffer(1000);
  for (;;) {
    if (!changed && ended.events >= until) {
      change();
      changed = true;
    }
    const auto n = (*source)->read(std::span(buffer).first(until == 1 && !changed ? 1 : buffer.size()));
    if (!n) return {ended.events, n.error().message, n.error().code};
    if (*n == 0) return ended;
    ended.events += *n;
  }
}

size_t count_of(const std::string& path, const ReadOptions& options) {
  const Recording r = read_path(path, options);
  EXPECT_EQ(r.error, "") << path;
  EXPECT_GE(r.events.size(), 100u) << path;
  return r.events.size();
}

constexpr When kWhen[] = {When::before_the_first_event, When::after_the_first_event,
                          When::after_the_last_event};

TEST_F(ChangingFiles, AnyChangeOfAnyFileIsAnError) {
  ASSERT_GE(kinds().size(), 14u);
  for (const Kind& kind : kinds()) {
    const size_t count = count_of(fresh(kind), kind.options);
    for (const std::string& file : kind.files) {
      for (const Change& change : kChanges) {
        for (const When when : kWhen) {
          SCOPED_TRACE(kind.name + ", " + file + ": " + change.name + " " + std::to_string(int(when)));
          const std::string opened = fresh(kind);
          const Ended ended =
              read_meanwhile(opened, kind.options, when, count, [&] { change.make(in_fresh(file)); });
          EXPECT_THAT(ended.error, AllOf(HasSubstr(in_fresh(file) + " changed while it was read ("),
                                         HasSubstr(change.told), HasSubstr("read it again")));
          EXPECT_EQ(ended.code, ErrorCode::bad_input);
        }
      }
    }
  }
}

TEST_F(ChangingFiles, WhatLeavesTheContentIsNoError) {
  for (const Kind& kind : kinds()) {
    const size_t count = count_of(fresh(kind), kind.options);
    for (const std::string& file : kind.files) {
      for (const Change& change : kHarmless) {
        SCOPED_TRACE(kind.name + ", " + file + ": " + change.name);
        const std::string opened = fresh(kind);
        const Ended ended = read_meanwhile(opened, kind.options, When::after_the_first_event, count,
                                           [&] { change.make(in_fresh(file)); });
        EXPECT_EQ(ended.error, "");
        EXPECT_EQ(ended.events, count);
      }
    }
  }
}

// rsync, cp -p and tar set the times of what they write: only the time of the last change tells.
TEST_F(ChangingFiles, OtherBytesWithTheOldTimeAreFoundByReadingAgain) {
  for (const Kind& kind : kinds()) {
    if (kind.by_library) continue;
    const size_t count = count_of(fresh(kind), kind.options);
    const std::string& file = kind.files.front();
    SCOPED_TRACE(kind.name);
    const std::string opened = fresh(kind);
    const Ended ended = read_meanwhile(opened, kind.options, When::after_the_last_event, count, [&] {
      overwrite_last_byte(in_fresh(file), 1);
      set_modified(in_fresh(file), kLongAgo);
    });
    EXPECT_THAT(ended.error, HasSubstr("its content is another one"));
  }
}

TEST_F(ChangingFiles, FramesAreWatchedUpToTheLastImage) {
  const Kind* ecd = nullptr;
  for (const Kind& kind : kinds()) ecd = kind.name == "ecd" ? &kind : ecd;
  ASSERT_NE(ecd, nullptr);
  for (const char* file : {"images.txt", "images/a.png"}) {
    const auto source = open_frames(fresh(*ecd), ecd->options);
    ASSERT_TRUE(source.ok());
    const auto first = (*source)->read();
    if (!first) GTEST_SKIP() << first.error().message;
    set_a_later_time(in_fresh(file));
    const auto second = (*source)->read();
    ASSERT_TRUE(second.ok() && *second) << "what was read is handed out";
    const auto end = (*source)->read();
    ASSERT_FALSE(end.ok());
    EXPECT_THAT(end.error().message, HasSubstr(std::string(file) + " changed while it was read"));
  }
}

TEST_F(ChangingFiles, TriggersAndUndecodedWordsAreWatched) {
  const std::string file = path("triggers.raw");
  const auto write = [&] {
    const Bytes bytes = evt2_file({0x80000001, 0xA0000101, 0xA0000100}, "% geometry 32x24\n");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    set_modified(file, kLongAgo);
  };
  for (const Change& change : kChanges) {
    SCOPED_TRACE(change.name);
    write();
    const auto triggers = open_triggers(file);
    ASSERT_TRUE(triggers.ok()) << triggers.error().message;
    std::array<Trigger, 1> one;
    ASSERT_TRUE((*triggers)->read(one).ok());
    change.make(file);
    Result<size_t> read = size_t{1};
    while (read && *read > 0) read = (*triggers)->read(one);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("changed while it was read"));

    write();
    const auto words = open_words(file);
    ASSERT_TRUE(words.ok()) << words.error().message;
    std::array<uint8_t, 4> bytes;
    ASSERT_TRUE((*words)->read(bytes).ok());
    EXPECT_TRUE((*words)->unchanged().ok());
    change.make(file);
    EXPECT_FALSE((*words)->unchanged().ok());
    read = size_t{1};
    while (read && *read > 0) read = (*words)->read(bytes);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("changed while it was read"));
  }
}

TEST_F(ChangingFiles, WhoStopsBeforeTheEndCanAsk) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const auto source = open_events(fresh(kind), kind.options);
    ASSERT_TRUE(source.ok()) << source.error().message;
    Event one;
    ASSERT_TRUE((*source)->read(std::span(&one, 1)).ok());
    EXPECT_TRUE((*source)->unchanged().ok());
    grow(in_fresh(kind.files.back()));
    EXPECT_FALSE((*source)->unchanged().ok());
  }
}

// A pipe has no content but what is read of it.
TEST_F(ChangingFiles, APipeIsNotWatched) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    for (const Event& e : events()) out << double(e.t) * 1e-6 << " " << e.x << " " << e.y << " 1\n";
  });
  const Ended ended = read_meanwhile(pipe, with_sensor(), When::after_the_first_event, events().size(), [&] {
    set_modified(pipe, kLongAgo);
    fs::remove(pipe);
  });
  writer.join();
  EXPECT_EQ(ended.error, "");
  EXPECT_EQ(ended.events, events().size());
}

TEST_F(ChangingFiles, BytesAreComparedHoweverTheyAreCut) {
  // 300,000 bytes: more than a reader's buffer, and no multiple of a block. One of them changes.
  const std::string file = path("bytes");
  Bytes content(300'001);
  for (size_t i = 0; i < content.size(); ++i) content[i] = static_cast<uint8_t>(i * 7 + i / 251);
  for (const size_t at :
       {size_t{0}, size_t{63}, size_t{64}, size_t{262'143}, size_t{262'144}, size_t{299'999}}) {
    for (const size_t read : {size_t{1000}, size_t{262'144}, size_t{300'001}}) {
      std::ofstream(file, std::ios::binary)
          .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
      set_modified(file, kLongAgo);
      InputFiles files;
      auto reader = files.open(file);
      ASSERT_TRUE(reader.ok());
      for (size_t left = read; left > 0;) {
        ASSERT_TRUE(reader->fill(1).ok());
        const size_t taken = std::min(left, reader->available().size());
        reader->skip(taken);
        left -= taken;
      }
      EXPECT_TRUE(files.unchanged().ok());
      {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(static_cast<std::streamoff>(at));
        stream.put(static_cast<char>(content[at] ^ 0x10));
      }
      set_modified(file, kLongAgo);
      // What the buffer holds was read, too.
      const size_t reached =
          (read + ByteReader::kCapacity - 1) / ByteReader::kCapacity * ByteReader::kCapacity;
      EXPECT_EQ(files.unchanged().ok(), at >= reached) << at << " of " << read;
    }
  }
}

TEST(FileState, IsSettledWhenTheStepsOfTheClockAreOver) {
  const FileState state{1, 2, 3, 100 * kSecond, 101 * kSecond};
  EXPECT_FALSE(settled(state, 101 * kSecond));
  EXPECT_FALSE(settled(state, 103 * kSecond));
  EXPECT_TRUE(settled(state, 103 * kSecond + 1));
  EXPECT_FALSE(settled(state, 50 * kSecond)) << "a file of the future";
}

}  // namespace
}  // namespace scarf
