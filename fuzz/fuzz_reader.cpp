#include "fuzz/fuzz_reader.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "io/base/format.h"
#include "io/open/open.h"

namespace scarf {
namespace {

struct Reading {
  std::string format;  // empty: it does not open
  std::vector<Event> events;
  ReadReport report;
};

Reading read_in_steps(const std::vector<uint8_t>& bytes, size_t bytes_at_a_time, size_t events_at_a_time,
                      const ReadOptions& options) {
  const auto read_some = [&, rest = std::span(bytes)](std::span<uint8_t> out) mutable -> Result<size_t> {
    const size_t count = std::min({out.size(), bytes_at_a_time, rest.size()});
    std::copy_n(rest.begin(), count, out.begin());
    rest = rest.subspan(count);
    return count;
  };
  auto source = open_input(ByteReader(read_some, bytes.size()), "fuzz", options);
  if (!source) return {};
  Reading reading;
  reading.format = (*source)->format();
  std::vector<Event> buffer(events_at_a_time);
  for (;;) {
    const auto count = (*source)->read(buffer);
    require(count.ok() && *count <= buffer.size());
    if (*count == 0) break;
    reading.events.insert(reading.events.end(), buffer.begin(),
                          buffer.begin() + static_cast<ptrdiff_t>(*count));
  }
  reading.report = (*source)->report();
  require((*source)->bytes_read() == bytes.size());
  require(reading.report.events == reading.events.size());
  for (const Event& e : reading.events) {
    require(e.p <= 1);
    require(!(*source)->sensor() || (*source)->sensor()->contains(e));
  }
  return reading;
}

// Frames and triggers have readers of their own.
void read_what_accompanies(std::span<const uint8_t> bytes, std::string_view format_name,
                           const ReadOptions& options) {
  const Format& format = **find_format(format_name);
  const auto input = [&] {
    Input input{ByteReader::over(bytes), "", "fuzz", false, {}};
    input.header = *read_prophesee_header(input.bytes);
    return input;
  };
  if (format.open_frames != nullptr) read_frames(format.open_frames(input(), options));
  if (format.open_triggers == nullptr) return;
  const auto read = [&](size_t batch) {
    return read_triggers(format.open_triggers(input(), options), batch);
  };
  require(read(1024) == read(3));
}

// None if an error ends them. A file may claim more events than it has bytes; beyond a million they prove
// nothing new.
std::vector<Event> read_path(const std::string& path, size_t batch, const ReadOptions& options) {
  constexpr size_t kMost = 1'000'000;
  std::vector<Event> events;
  auto source = open_events(path, options);
  std::vector<Event> buffer(batch);
  while (source && events.size() < kMost) {
    const auto count = (*source)->read(buffer);
    if (!count) return {};
    require(*count <= buffer.size());
    if (*count == 0) break;
    events.insert(events.end(), buffer.begin(), buffer.begin() + static_cast<ptrdiff_t>(*count));
  }
  events.resize(std::min(events.size(), kMost));
  for (const Event& e : events) {
    require(e.p <= 1);
    require(!(*source)->sensor() || (*source)->sensor()->contains(e));
  }
  return events;
}

}  // namespace

void require(bool condition) {
  if (!condition) std::abort();
}

void read_frames(const Result<std::unique_ptr<FrameSource>>& source) {
  while (source) {
    const auto frame = (*source)->read();
    if (!frame || !*frame) return;
    const Image<uint8_t>& image = (*frame)->image;
    require(image.pixels.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  }
}

std::vector<Trigger> read_triggers(const Result<std::unique_ptr<TriggerSource>>& source, size_t batch) {
  std::vector<Trigger> triggers;
  std::vector<Trigger> some(batch);
  while (source) {
    const auto count = (*source)->read(some);
    if (!count) return {};
    if (*count == 0) break;
    require(*count <= some.size());
    triggers.insert(triggers.end(), some.begin(), some.begin() + static_cast<ptrdiff_t>(*count));
  }
  return triggers;
}

void check_reader(std::string_view header, std::span<const uint8_t> data, const ReadOptions& options) {
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  const Reading whole = read_in_steps(bytes, bytes.size(), 1024, options);
  const Reading pieces = read_in_steps(bytes, 5, 3, options);
  require(whole.events == pieces.events);
  require(whole.report.outside == pieces.report.outside);
  require(whole.report.back_steps == pieces.report.back_steps);
  require(whole.report.unknown_words == pieces.report.unknown_words);
  require(whole.report.truncated_bytes == pieces.report.truncated_bytes);
  if (!whole.format.empty()) read_what_accompanies(bytes, whole.format, options);
}

void check_path(const std::string& path, const ReadOptions& options) {
  require(read_path(path, 1024, options) == read_path(path, 3, options));
}

}  // namespace scarf
