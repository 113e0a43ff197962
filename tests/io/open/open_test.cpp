// Recognition, headers, geometry, pipes.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"
#include "tests/support/archive_bytes.h"

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::optional<SensorSize> sensor_of(std::string_view header, const ReadOptions& options = {}) {
  const auto r = read_all(with_words<uint32_t>(header, {0x80000000u, 0x10000000u}), options);
  EXPECT_EQ(r.error, "") << header;
  return r.sensor;
}

std::string error_of(std::string_view header, const ReadOptions& options = {}) {
  return read_all(with_words<uint32_t>(header, {0x80000000u, 0x10000000u}), options).error;
}

TEST(PropheseeHeader, FindsTheSensor) {
  EXPECT_EQ(sensor_of("% format EVT2;height=720;width=1280\n% end\n"), (SensorSize{1280, 720}));
  EXPECT_EQ(sensor_of("% format EVT2;width=1280;height=720;endianness=little\r\n% end\r\n"),
            (SensorSize{1280, 720}));
  EXPECT_EQ(sensor_of("% evt 2.0\n% geometry 640x480\n% end\n"), (SensorSize{640, 480}));
  EXPECT_EQ(sensor_of("% Date 2020-09-25 07:48:31\n% system_ID 21\n"), (SensorSize{640, 480}));
  EXPECT_EQ(sensor_of("% evt 2.0\n% system_ID 154\n% end\n"), (SensorSize{1280, 720}))
      << "26 with the EVK proxy bit";
  EXPECT_EQ(sensor_of("% evt 2.0\n% system_ID 999\n% end\n"), std::nullopt);
  EXPECT_EQ(sensor_of("% evt 2.0\n% system_ID 21\n% geometry 304x240\n% end\n"), (SensorSize{304, 240}));
}

TEST(PropheseeHeader, TheFormatComesFromFormatThenEvtThenSystem) {
  const auto format_of = [](std::string_view header) { return read_all(bytes_of(header)).format; };
  EXPECT_EQ(format_of("% evt 2.0\n% format EVT3;height=720;width=1280\n% end\n"), "evt3");
  EXPECT_EQ(format_of("% evt 3.0\n% system_ID 21\n% end\n"), "evt3");
  EXPECT_EQ(format_of("% evt 2.1\n% end\n"), "evt21");
  EXPECT_EQ(format_of("% evt 4.0\n% end\n"), "evt4");
  EXPECT_EQ(format_of("% system_ID 48\n% end\n"), "evt3");
  EXPECT_EQ(format_of("% system_ID 21\n% end\n"), "evt2");
}

TEST(PropheseeHeader, RefusesWhatItCannotMean) {
  EXPECT_THAT(error_of("% format EVT2;height=720;width=1280\n% geometry 640x480\n% end\n"),
              AllOf(HasSubstr("1280x720"), HasSubstr("640x480")));
  EXPECT_THAT(error_of("% evt 2.0\n% geometry 0x480\n% end\n"), HasSubstr("0x480"));
  EXPECT_THAT(error_of("% evt 2.0\n% geometry large\n% end\n"), HasSubstr("large"));
  EXPECT_THAT(error_of("% format EVT2;width=640\n% end\n"), HasSubstr("format"));
  EXPECT_THAT(error_of("% format HISTO3D;height=720;width=1280\n% end\n"), HasSubstr("HISTO3D"));
  EXPECT_THAT(error_of("% evt 5.0\n% end\n"), HasSubstr("5.0"));
  EXPECT_THAT(error_of("% Version two\n% end\n"), HasSubstr("two"));
  EXPECT_THAT(error_of("% serial_number 5\n% end\n"), HasSubstr("no format"));
}

TEST(PropheseeHeader, WithoutEndTheWordsBeginAfterTheLastLine) {
  // The second word begins like a header line, "% ", and a newline follows it.
  const auto r = read_all(with_words<uint32_t>("% evt 2.0\n", {0x80000001u, 0x10012025u, 0x8000000Au}));
  EXPECT_EQ(r.events.size(), 1u);
  const auto chance = read_all(with_words<uint16_t>("% evt 3.0\n", {0x2025, 0x8001, 0x200A, 0x2001}));
  EXPECT_EQ(chance.events.size(), 2u) << "0x2025 is not the beginning of another header line";
}

TEST(PropheseeHeader, AnEndlessLineIsAnErrorAndIsNotBuffered) {
  uint64_t served = 0;
  const auto endless = [&served](std::span<uint8_t> out) -> Result<size_t> {
    if (served > (uint64_t{1} << 30)) return size_t{0};
    std::fill(out.begin(), out.end(), uint8_t{'a'});
    if (served == 0) out[0] = '%', out[1] = ' ';
    served += out.size();
    return out.size();
  };
  EXPECT_THAT(read_all(ByteReader(endless, 0)).error, HasSubstr("header line"));
  EXPECT_LE(served, ByteReader::kCapacity);
}

TEST(Open, AnInputLongerThanItSaysIsReadWhole) {
  Bytes bytes(200'000);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(i * i >> 5);
  for (const uint64_t claimed : {uint64_t{1}, uint64_t{100}, bytes.size() + 1}) {
    const auto read_some = [&, rest = std::span(bytes)](std::span<uint8_t> out) mutable -> Result<size_t> {
      const size_t count = std::min<size_t>(out.size(), rest.size());
      std::copy_n(rest.begin(), count, out.begin());
      rest = rest.subspan(count);
      return count;
    };
    ByteReader reader(read_some, claimed);
    ASSERT_TRUE(reader.fill(1000).ok());
    reader.skip(7);
    ASSERT_TRUE(reader.fill(bytes.size()).ok());
    EXPECT_TRUE(std::ranges::equal(reader.available(), std::span(bytes).subspan(7)));
    EXPECT_TRUE(reader.ended());
  }
}

TEST(Open, FileAndOptionMustAgree) {
  EXPECT_EQ(sensor_of("% evt 2.0\n% end\n", {SensorSize{304, 240}}), (SensorSize{304, 240}));
  EXPECT_EQ(sensor_of("% evt 2.0\n% geometry 304x240\n% end\n", {SensorSize{304, 240}}),
            (SensorSize{304, 240}));
  EXPECT_THAT(error_of("% evt 2.0\n% system_ID 21\n% end\n", {SensorSize{304, 240}}),
              AllOf(HasSubstr("640x480"), HasSubstr("304x240")));
  EXPECT_THAT(error_of("% evt 2.0\n% end\n", {SensorSize{0, 240}}), HasSubstr("0x240"));
  EXPECT_THAT(read_all(bytes_of("240 180\n0.1 1 1 1\n"), {SensorSize{304, 240}}).error,
              AllOf(HasSubstr("240x180"), HasSubstr("304x240")));
}

TEST(Open, NamesWhatItCannotRead) {
  const auto error = [](std::string_view start) { return read_all(bytes_of(start)).error; };
  EXPECT_THAT(error(std::string_view("PK\x03\x04\x14\0\0\0", 8)), HasSubstr("zip archive"));
  EXPECT_THAT(error("#!AER-DAT3.0\r\n"), HasSubstr("another version than 1, 2, 3.1 and 4.0"));
  EXPECT_THAT(error("\x89HDF\r\n\x1a\n"), HasSubstr("HDF5"));
  EXPECT_THAT(error("\x89PNG\r\n\x1a\n"), HasSubstr("PNG"));
  EXPECT_THAT(error(""), HasSubstr("empty"));
  const std::string what = error("what is this?");
  EXPECT_THAT(what, AllOf(HasSubstr("test.raw"), HasSubstr("not recognised"), HasSubstr("formats()"),
                          HasSubstr("ReadOptions::format")));
  EXPECT_THAT(what, Not(HasSubstr("\n")));
}

TEST(Open, AMissingFileIsAnIoErrorAndAnyFolderNoRecording) {
  const auto missing = open_events("/nonexistent/events.raw");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::io);
  EXPECT_THAT(missing.error().message, HasSubstr("/nonexistent/events.raw"));
  const auto folder = open_events("/");
  ASSERT_FALSE(folder.ok());
  EXPECT_EQ(folder.error().code, ErrorCode::unrecognised);
  EXPECT_THAT(folder.error().message, HasSubstr("folder"));
}

// Such files lie beside recordings: they are none, rather than broken ones.
TEST(Open, WhatHoldsNoEventsIsNoRecording) {
  using test::npy_file;
  using test::zip_file;
  const Bytes labels = npy_file("[('t', '<u8'), ('w', '<f4')]", "(1,)", Bytes(12));
  const Bytes matrix = npy_file("'<f8'", "(3, 3)", Bytes(72));
  // t, x, y, p and something else, twice.
  Bytes five(80);
  for (size_t i = 0; i < 5; ++i) five[8 * i] = std::array<uint8_t, 5>{1, 200, 100, 1, 50}[i];
  for (size_t i = 0; i < 5; ++i) five[40 + 8 * i] = std::array<uint8_t, 5>{9, 20, 10, 0, 5}[i];
  const Bytes five_columns = npy_file("'<i8'", "(2, 5)", five);
  const Bytes boxes = npy_file("'<f8'", "(2, 4)", Bytes(64, 0x3f));
  const Bytes poses = npy_file("'<i8'", "(1, 7)", Bytes(56));
  const Bytes picture = npy_file("'|u1'", "(4, 640)", Bytes(2560));
  const Bytes column = npy_file("'<i8'", "(1,)", Bytes(8));
  const Bytes prose = bytes_of("Once upon a time\n");
  const auto code = [](const Bytes& bytes, const ReadOptions& options = {}) {
    const TemporaryFile file(bytes);
    const auto source = open_events(file.path(), options);
    return source.ok() ? std::nullopt : std::optional(source.error().code);
  };
  EXPECT_EQ(code(labels), ErrorCode::unrecognised);
  EXPECT_EQ(code(matrix), ErrorCode::unrecognised);
  EXPECT_EQ(code(boxes), ErrorCode::unrecognised);
  EXPECT_EQ(code(poses), ErrorCode::unrecognised);
  EXPECT_EQ(code(picture), ErrorCode::unrecognised);
  EXPECT_EQ(code(five_columns), ErrorCode::bad_input);  // --columns may make events of it
  EXPECT_EQ(code(labels, read_options("", "", "", "npy")), ErrorCode::bad_input);
  EXPECT_EQ(code(with_words<uint32_t>("% Version 2\n\x0E\x08", {3, 0x0200u})), ErrorCode::unrecognised);

  // An MCAP with nothing in it, and one that ends before it can tell.
  const Bytes mcap = bytes_of("\x89MCAP0\r\n");
  Bytes empty = mcap;
  for (const int byte : {15, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}) empty.push_back(static_cast<uint8_t>(byte));
  EXPECT_EQ(code(empty), ErrorCode::unrecognised);
  EXPECT_EQ(code(mcap), ErrorCode::bad_input);

  if (const auto missing = missing_library("npz"); !missing.empty()) GTEST_SKIP() << missing;
  EXPECT_EQ(code(zip_file({{"labels.npy", labels}, {"K.npy", matrix}})), ErrorCode::unrecognised);
  EXPECT_EQ(code(zip_file({{"events.npy", five_columns}})), ErrorCode::bad_input);
  EXPECT_EQ(code(zip_file({{"t.npy", column}, {"x.npy", column}, {"y.npy", column}, {"p.npy", matrix}})),
            ErrorCode::bad_input);
  EXPECT_EQ(code(zip_file({{"a.png", Bytes(9)}, {"b.png", Bytes(9)}})), ErrorCode::unrecognised);
  EXPECT_EQ(code(zip_file({{"README.txt", prose}})), ErrorCode::unrecognised);
  EXPECT_EQ(code(zip_file({{"a/events.txt", prose}, {"b/events.txt", prose}})), ErrorCode::bad_input);
}

// A file that should have been a recording is a failure, and the same under another name is passed over.
TEST(Open, WhatStandsInForARecordingIsNamed) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') + "\nsize 8366716\n";
  const std::string page = "\n<!DOCTYPE HTML><html><head><title>Virus scan warning</title></head></html>\n";
  const std::string refusal = "<?xml version=\"1.0\"?><Error><Code>AccessDenied</Code></Error>";
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& name, const std::string& content, ErrorCode code,
                          const char* what) {
    SCOPED_TRACE(name);
    folder.add(name, bytes_of(content));
    const auto source = open_events(folder.path() + "/" + name);
    ASSERT_FALSE(source.ok());
    EXPECT_EQ(source.error().code, code);
    EXPECT_THAT(source.error().message, AllOf(HasSubstr(name), HasSubstr(what)));
  };
  for (const char* name :
       {"a.raw", "a.dat", "a.aedat4", "a.h5", "a.bag", "a.csv", "a.npz", "events", "a.RAW"}) {
    expect(name, pointer, ErrorCode::bad_input, "git lfs pull");
  }
  for (const char* name : {"a.png", "a.yaml", "a.md", "a.tar"}) {
    expect(name, pointer, ErrorCode::unrecognised, "git lfs pull");
  }
  for (const char* name : {"a.raw", "a.zip", "a.h5", "a.txt", "a.mcap"}) {
    expect(name, page, ErrorCode::bad_input, "page");
    expect(name, refusal, ErrorCode::bad_input, "page");
  }
  for (const char* name : {"index.html", "a.xml", "LICENSE"})
    expect(name, page, ErrorCode::unrecognised, "page");
  for (const char* name : {"a.raw", "a.h5", "a.aedat4", "a.zip", "a.npy"}) {
    expect(name, "", ErrorCode::bad_input, "fetch it again");
  }
  for (const char* name : {"a.txt", "a.png", "log"}) expect(name, "", ErrorCode::unrecognised, "empty");
  expect("b.aedat4", "#!AER-DA", ErrorCode::bad_input, "cut or damaged");
  expect("b.bag", "#ROS", ErrorCode::bad_input, "cut or damaged");
  expect("b.zip", "PK\x03\x04 and no more", ErrorCode::bad_input, "zip");
  expect("b.h5", std::string("\x89HDF\r\n\x1a\n\0\0", 10), ErrorCode::bad_input, "HDF5");
  expect("b.gz", "\x1f\x8b\b and no more", ErrorCode::unrecognised, "unpack");
  expect("b.jpg", "\xff\xd8\xff\xe0", ErrorCode::unrecognised, "JPEG");
  expect("b.csv", std::string("\xff\xfet\0,\0x\0,\0y\0,\0p\0\n\0", 18), ErrorCode::bad_input, "UTF-16");
  // Nor is it words because somebody names their format.
  folder.add("c.raw", bytes_of(pointer));
  const auto named = open_events(folder.path() + "/c.raw", read_options("", "", "", "evt3"));
  ASSERT_FALSE(named.ok());
  EXPECT_THAT(named.error().message, HasSubstr("git lfs pull"));
}

// The header of the recording, and behind it places in the recording.
TEST(Open, AnIndexOfOpenEbIsNoRecording) {
  for (const char* key : {"% index_version 2.0\n", "% bookmark_period_us 2000\n"}) {
    Bytes index = bytes_of(std::string("% evt 3.0\n% format EVT3;height=720;width=1280\n") + key + "% end\n");
    for (uint64_t i = 0; i < 200; ++i) {
      append_little_endian(index, 2000 * i);
      append_little_endian(index, 160 + 5000 * i);
      append_little_endian(index, static_cast<uint32_t>(i * 77));
    }
    const TemporaryFile file(index);
    for (const char* format : {"", "evt3"}) {
      const auto source = open_events(file.path(), read_options("", "", "", format));
      ASSERT_FALSE(source.ok());
      EXPECT_EQ(source.error().code, ErrorCode::unrecognised);
      EXPECT_THAT(source.error().message, HasSubstr("index that OpenEB keeps"));
    }
    EXPECT_FALSE(open_triggers(file.path()).ok());
  }
}

TEST(Open, AFolderOfAnotherProgramIsNoRecording) {
  const TemporaryFolder folder;
  folder.add("metadata.yaml", bytes_of("name: somebody else's\n"));
  const auto source = open_events(folder.path());
  ASSERT_FALSE(source.ok());
  EXPECT_EQ(source.error().code, ErrorCode::unrecognised);
}

TEST(Open, RequireSensorAsksForTheOption) {
  const Bytes without = evt2_file({});
  const Bytes with = evt2_file({}, "% geometry 640x480\n");
  const auto unknown = open_input(ByteReader::over(without), "a.raw");
  const auto known = open_input(ByteReader::over(with), "a.raw");
  EXPECT_THAT(require_sensor(**unknown, "a.raw").error().message,
              AllOf(HasSubstr("a.raw"), HasSubstr("ReadOptions::sensor WxH")));
  EXPECT_EQ(*require_sensor(**known, "a.raw"), (SensorSize{640, 480}));
}

TEST(Open, FilesSayHowFarTheyAreRead) {
  const TemporaryFile file(evt2_file({0x80000000u, 0x10000000u, 0x10000001u}));
  auto source = open_events(file.path());
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ((*source)->bytes_total(), file.content().size());
  std::vector<Event> one(1);
  EXPECT_EQ(*(*source)->read(one), 1u);
  EXPECT_EQ((*source)->bytes_read(), file.content().size() - 4);
  EXPECT_EQ(*(*source)->read(one), 1u);
  EXPECT_EQ(*(*source)->read(one), 0u);
  EXPECT_EQ(*(*source)->read(one), 0u) << "the end stays the end";
  EXPECT_EQ((*source)->bytes_read(), file.content().size());
}

TEST(Open, AReadErrorComesAfterTheEventsBeforeIt) {
  const Bytes bytes = evt2_file({0x80000000u, 0x10000000u, 0x10000001u});
  bool served = false;
  const auto failing = [&](std::span<uint8_t> out) -> Result<size_t> {
    if (served) return Error{ErrorCode::io, "cannot read: broken"};
    served = true;
    std::copy(bytes.begin(), bytes.end(), out.begin());
    return bytes.size();
  };
  const auto r = read_all(ByteReader(failing, 0));
  EXPECT_EQ(r.events.size(), 2u);
  EXPECT_THAT(r.error, AllOf(HasSubstr("test.raw"), HasSubstr("broken")));
}

// Feeds bytes to standard input through a pipe, and gives back the old standard input.
class PipedStandardInput {
 public:
  explicit PipedStandardInput(Bytes bytes) : saved_(dup(STDIN_FILENO)) {
    int ends[2];
    if (pipe(ends) != 0) ADD_FAILURE() << "no pipe";
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    writer_ = std::thread([fd = ends[1], content = std::move(bytes)] {
      for (size_t at = 0; at < content.size();) {
        const ssize_t count = write(fd, content.data() + at, std::min<size_t>(content.size() - at, 1000));
        if (count <= 0) break;
        at += static_cast<size_t>(count);
      }
      close(fd);
    });
  }
  ~PipedStandardInput() {
    writer_.join();
    dup2(saved_, STDIN_FILENO);
    close(saved_);
  }

 private:
  int saved_;
  std::thread writer_;
};

TEST(Open, ReadsStandardInputFromAPipe) {
  std::string content = "240 180\n";
  for (int i = 0; i < 50'000; ++i) content += "0.5 " + std::to_string(i % 240) + " 7 1\n";
  const PipedStandardInput piped(bytes_of(content));
  auto source = open_events("-");
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ((*source)->bytes_total(), 0u);
  const auto r = read_all(*std::move(source), 777);
  EXPECT_EQ(r.events.size(), 50'000u);
  EXPECT_EQ(r.events.back(), (Event{500'000, 49'999 % 240, 7, 1}));
}

TEST(Open, ALivePipeIsNotHeldBack) {
  const TemporaryFile file;
  ASSERT_EQ(mkfifo(file.path().c_str(), 0600), 0);
  const Bytes first = evt2_file({0x80000000u, 0x10000000u});
  // The writing end stays open all the time, so a reader that waits for more than is there hangs.
  std::thread writer;
  int fd = -1;
  writer = std::thread([&] {
    fd = open(file.path().c_str(), O_WRONLY);
    EXPECT_EQ(write(fd, first.data(), first.size()), static_cast<ssize_t>(first.size()));
  });
  auto source = open_events(file.path());
  ASSERT_TRUE(source.ok()) << source.error().message;
  writer.join();
  std::vector<Event> events(100);
  EXPECT_EQ(*(*source)->read(events), 1u);
  close(fd);
  EXPECT_EQ(*(*source)->read(events), 0u);
}

}  // namespace
}  // namespace scarf
