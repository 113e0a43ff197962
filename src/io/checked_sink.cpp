#include "io/checked_sink.h"

#include <algorithm>
#include <utility>

namespace scarf {
namespace {

// Events encoded between two looks at the size of the output buffer.
constexpr size_t kChunk = 16 * 1024;

}  // namespace

CheckedSink::CheckedSink(ByteWriter output, SensorSize sensor, const WriteLimits& limits)
    : output_(std::move(output)), check_(sensor, limits) {}

Result<void> CheckedSink::write(std::span<const Event> events) {
  while (!events.empty()) {
    const auto chunk = events.first(std::min(events.size(), kChunk));
    const size_t good = check_.accepted(chunk);
    encode(chunk.first(good));
    if (const auto flushed = output_.flush_if_large(); !flushed) return flushed;
    if (good < chunk.size()) return check_.refusal(output_.path(), chunk[good]);
    events = events.subspan(good);
  }
  return {};
}

Result<void> CheckedSink::finish() {
  if (const auto completed = complete(); !completed) return completed;
  return output_.finish();
}

}  // namespace scarf
