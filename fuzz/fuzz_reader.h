// What every reader must hold for any bytes: no fault, and the same events and report however they are read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/open.h"

namespace scarf {

struct Reading {
  std::vector<Event> events;
  ReadReport report;
};

inline void require(bool condition) {
  if (!condition) std::abort();
}

inline Reading read_in_steps(const std::vector<uint8_t>& bytes, size_t bytes_at_a_time,
                             size_t events_at_a_time, const ReadOptions& options = {}) {
  const auto read_some = [&, rest = std::span(bytes)](std::span<uint8_t> out) mutable -> Result<size_t> {
    const size_t count = std::min({out.size(), bytes_at_a_time, rest.size()});
    std::copy_n(rest.begin(), count, out.begin());
    rest = rest.subspan(count);
    return count;
  };
  auto source = open_input(ByteReader(read_some, 0), "fuzz", options);
  if (!source) return {};
  Reading reading;
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

inline void check_reader(std::string_view header, std::span<const uint8_t> data,
                         const ReadOptions& options = {}) {
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  const Reading whole = read_in_steps(bytes, bytes.size(), 1024, options);
  const Reading pieces = read_in_steps(bytes, 5, 3, options);
  require(whole.events == pieces.events);
  require(whole.report.outside == pieces.report.outside);
  require(whole.report.back_steps == pieces.report.back_steps);
  require(whole.report.unknown_words == pieces.report.unknown_words);
  require(whole.report.truncated_bytes == pieces.report.truncated_bytes);
}

}  // namespace scarf
