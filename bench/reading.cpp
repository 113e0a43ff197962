#include "bench/reading.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <vector>

#include "bench/unpacking.h"
#include "core/text.h"

namespace scarf::bench {
namespace {

constexpr size_t kEventsAtOnce = 16 * 1024;
constexpr size_t kBytesAtOnce = 256 * 1024;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double processor_ns() {
  return static_cast<double>(std::clock()) * (1e9 / CLOCKS_PER_SEC);
}

Result<uint64_t> read_events(EventSource& source, std::vector<Event>& buffer) {
  uint64_t events = 0;
  for (;;) {
    const auto count = source.read(buffer);
    if (!count) return count.error();
    if (*count == 0) return events;
    events += *count;
  }
}

// A folder's files together.
uint64_t read_bytes(const std::string& path, std::vector<char>& buffer) {
  uint64_t bytes = 0;
  const auto read_file = [&](const std::filesystem::path& file) {
    std::ifstream in;
    in.rdbuf()->pubsetbuf(nullptr, 0);
    in.open(file, std::ios::binary);
    do {
      in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
      bytes += static_cast<uint64_t>(in.gcount());
    } while (in);
  };
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) {
    read_file(path);
    return bytes;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path, ignored)) {
    if (entry.is_regular_file(ignored)) read_file(entry.path());
  }
  return bytes;
}

}  // namespace

Result<ReadTime> time_reading(const std::string& path, const ReadOptions& options, int repeats) {
  ReadTime time;
  std::vector<double> reading, file, unpacking;
  std::vector<Event> events(kEventsAtOnce);
  std::vector<char> bytes(kBytesAtOnce);
  for (int i = 0; i <= repeats; ++i) {
    auto source = open_events(path, options);
    if (!source) return source.error();
    const double begin = processor_ns();
    const auto count = read_events(**source, events);
    const double end = processor_ns();
    if (!count) return count.error();
    if (*count == 0) return Error{ErrorCode::bad_input, text(path, ": there are no events to time")};
    time.format = (*source)->format();
    time.events = *count;
    const double file_begin = processor_ns();
    time.bytes = read_bytes(path, bytes);
    const double file_end = processor_ns();
    const auto unpacked = unpack_blocks(path, time.format, options);
    const double unpacking_end = processor_ns();
    if (!unpacked) return unpacked.error();
    if (i == 0) continue;
    reading.push_back((end - begin) / static_cast<double>(*count));
    file.push_back((file_end - file_begin) / static_cast<double>(*count));
    if (*unpacked) unpacking.push_back((unpacking_end - file_end) / static_cast<double>(*count));
  }
  time.ns_per_event = median(reading);
  time.file_ns_per_event = median(file);
  if (!unpacking.empty()) time.unpacking_ns_per_event = median(unpacking);
  return time;
}

}  // namespace scarf::bench
