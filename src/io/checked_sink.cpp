#include "io/checked_sink.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/sensor_size.h"

namespace scarf {
namespace {

// Events encoded between two looks at the size of the output buffer.
constexpr size_t kChunk = 16 * 1024;

}  // namespace

CheckedSink::CheckedSink(ByteWriter output, SensorSize sensor, const WriteLimits& limits)
    : output_(std::move(output)), sensor_(sensor), limits_(limits), previous_t_(limits.t_min) {}

std::string_view CheckedSink::objection(const Event& e) const {
  if (e.p > 1) return "its polarity must be 0 or 1";
  if (!sensor_.contains(e)) return "it is outside the sensor; drop it";
  if (e.x > limits_.max_coordinate || e.y > limits_.max_coordinate) {
    return "the format holds coordinates up to 2047 only; write text";
  }
  if (e.t < limits_.t_min) return "the format cannot hold so early a time; shift the times or write text";
  if (e.t >= limits_.t_end) return "the format cannot hold so late a time; shift the times or write text";
  if (e.t < previous_t_ && !limits_.back_steps) {
    return "the format cannot hold a time before that of the event before it; sort the events or write text";
  }
  return {};
}

Result<void> CheckedSink::write(std::span<const Event> events) {
  while (!events.empty()) {
    const auto chunk = events.first(std::min(events.size(), kChunk));
    size_t good = 0;
    std::string_view wrong;
    for (; good < chunk.size(); ++good) {
      wrong = objection(chunk[good]);
      if (!wrong.empty()) break;
      previous_t_ = chunk[good].t;
    }
    encode(chunk.first(good));
    count_ += good;
    if (const auto flushed = output_.flush_if_large(); !flushed) return flushed;
    if (good < chunk.size()) {
      const Event& e = chunk[good];
      return Error{ErrorCode::bad_input,
                   text(output_.path(), ": event ", count_, " (t ", e.t, ", x ", e.x, ", y ", e.y, ", p ",
                        int{e.p}, ") cannot be written as ", limits_.format, " for a sensor of ",
                        size_text(sensor_), ": ", wrong)};
    }
    events = events.subspan(good);
  }
  return {};
}

Result<void> CheckedSink::finish() {
  if (const auto completed = complete(); !completed) return completed;
  return output_.finish();
}

}  // namespace scarf
