// What the tests of the readers and writers share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/little_endian.h"
#include "io/open/open.h"
#include "scarf/io/recordings.h"

namespace scarf {

inline void PrintTo(const Event& e, std::ostream* out) {
  *out << "{t " << e.t << ", x " << e.x << ", y " << e.y << ", p " << int{e.p} << "}";
}

inline void PrintTo(const ReadReport& r, std::ostream* out) {
  *out << "{events " << r.events << ", outside " << r.outside << ", back-steps " << r.back_steps << " up to "
       << r.largest_back_step << ", unknown " << r.unknown_words << ", truncated " << r.truncated_bytes
       << "}";
}

using Bytes = std::vector<uint8_t>;

inline Bytes bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

/// Text, then little-endian words.
template <class Word>
Bytes with_words(std::string_view header, std::initializer_list<Word> words) {
  Bytes bytes = bytes_of(header);
  for (const Word word : words) {
    for (size_t i = 0; i < sizeof(Word); ++i) bytes.push_back(static_cast<uint8_t>(word >> (8 * i)));
  }
  return bytes;
}

inline Bytes evt2_file(std::initializer_list<uint32_t> words, std::string_view more_header = "") {
  return with_words("% evt 2.0\n" + std::string(more_header) + "% end\n", words);
}

inline Bytes evt3_file(std::initializer_list<uint16_t> words, std::string_view more_header = "") {
  return with_words("% evt 3.0\n" + std::string(more_header) + "% end\n", words);
}

/// What is empty is left as it is.
inline ReadOptions read_options(std::string stream, std::string columns = "", std::string time_unit = "",
                                std::string format = "") {
  ReadOptions options;
  options.stream = std::move(stream);
  options.columns = std::move(columns);
  options.time_unit = std::move(time_unit);
  options.format = std::move(format);
  return options;
}

struct Recording {
  std::string format;
  std::optional<SensorSize> sensor;
  std::vector<Event> events;
  ReadReport report;
  std::string error;  // of opening or reading; empty if there was none
};

inline Recording read_all(std::unique_ptr<EventSource> source, size_t batch) {
  Recording recording;
  std::vector<Event> buffer(batch);
  for (;;) {
    for (Event& e : buffer) e.padding[1] = 0xA5;  // a reader must not leave the caller's bytes in an event
    const auto count = source->read(buffer);
    if (!count) recording.error = count.error().message;
    if (!count || *count == 0) break;
    for (size_t i = 0; i < *count; ++i) EXPECT_EQ(buffer[i].padding[1], 0);
    recording.events.insert(recording.events.end(), buffer.begin(),
                            buffer.begin() + static_cast<ptrdiff_t>(*count));
  }
  recording.format = source->format();
  recording.sensor = source->sensor();
  recording.report = source->report();
  return recording;
}

inline Recording read_all(ByteReader input, const ReadOptions& options = {}, size_t batch = 4096) {
  auto source = open_input(std::move(input), "test.raw", options);
  if (!source) return {"", std::nullopt, {}, {}, source.error().message};
  return read_all(*std::move(source), batch);
}

inline Recording read_all(const Bytes& bytes, const ReadOptions& options = {}, size_t batch = 4096) {
  return read_all(ByteReader::over(bytes), options, batch);
}

/// An input that hands out `step` bytes at a time, as a slow pipe does.
inline ByteReader dripping(const Bytes& bytes, size_t step) {
  const auto read_some = [&bytes, step, at = size_t{0}](std::span<uint8_t> out) mutable -> Result<size_t> {
    const size_t count = std::min({out.size(), step, bytes.size() - at});
    std::copy_n(bytes.begin() + static_cast<ptrdiff_t>(at), count, out.begin());
    at += count;
    return count;
  };
  return ByteReader(read_some, 0);
}

/// The library without which this build cannot read the format; empty if it can.
inline std::string missing_library(std::string_view format) {
  for (const FormatInfo& info : formats()) {
    if (info.name == format) return info.missing;
  }
  return "";
}

/// A file name of this test, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("scarf_") + test->test_suite_name() + "_" + test->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    path_ = (std::filesystem::temp_directory_path() / name).string();
  }
  explicit TemporaryFile(const Bytes& content) : TemporaryFile() {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }

  const std::string& path() const { return path_; }
  Bytes content() const {
    std::ifstream file(path_, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
  }

 private:
  std::string path_;
};

/// A folder of this test, removed with all that it holds at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() { std::filesystem::remove_all(path()); }
  ~TemporaryFolder() { std::filesystem::remove_all(path()); }

  const std::string& path() const { return name_.path(); }
  /// Writes a file; folders within its name are made.
  void add(const std::string& name, const Bytes& content) const {
    const auto file = std::filesystem::path(path()) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  }

 private:
  TemporaryFile name_;
};

/// As read_all, from a path.
inline Recording read_path(const std::string& path, const ReadOptions& options = {}, size_t batch = 4096) {
  auto source = open_events(path, options);
  if (!source) return {"", std::nullopt, {}, {}, source.error().message};
  return read_all(*std::move(source), batch);
}

}  // namespace scarf
