#include "io/base/checked_sink.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/prophesee_header.h"

namespace scarf {
namespace {

// Events encoded between two looks at the size of the output buffer.
constexpr size_t kChunk = 16 * 1024;

constexpr size_t kMaxQuote = 40;  // characters of a line that is refused

}  // namespace

CheckedSink::CheckedSink(ByteWriter output, SensorSize sensor, const WriteLimits& limits)
    : output_(std::move(output)), check_(sensor, limits) {}

Result<void> CheckedSink::write_header(std::span<const HeaderLine> lines) {
  if (auto r = check_.accept_header(output_.path()); !r) return r;
  if (begun_) {
    return Error{ErrorCode::illegal_parameter,
                 text(output_.path(), ": lines of the header must come before events and triggers")};
  }
  for (const HeaderLine& line : lines) {
    if (is_camera_line(line)) continue;
    return Error{ErrorCode::bad_input,
                 text(output_.path(), ": '", line.key, " ", line.value.substr(0, kMaxQuote),
                      "' cannot be a line of the header")};
  }
  header_.insert(header_.end(), lines.begin(), lines.end());
  return {};
}

void CheckedSink::begin() {
  if (!std::exchange(begun_, true)) encode_header(header_);
}

Result<void> CheckedSink::write_triggers(std::span<const Trigger> triggers) {
  begin();
  for (const Trigger& trigger : triggers) {
    if (auto r = check_.accept(output_.path(), trigger); !r) return r;
    encode_trigger(trigger);
    if (auto r = output_.flush_if_large(); !r) return r;
  }
  return {};
}

Result<void> CheckedSink::write(std::span<const Event> events) {
  begin();
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
  begin();
  if (const auto completed = complete(); !completed) return completed;
  return output_.finish();
}

}  // namespace scarf
