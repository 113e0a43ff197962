#include "io/base/event_check.h"

#include "core/text.h"
#include "io/base/sensor_size.h"

namespace scarf {

std::string_view EventCheck::objection(const Event& e) const {
  if (e.p > 1) return "its polarity must be 0 or 1";
  if (!sensor_.contains(e)) return "it is outside the sensor; drop it";
  if (e.x > limits_.max_coordinate || e.y > limits_.max_coordinate) {
    return "the format holds coordinates up to 2047 only; write another one, dat or text";
  }
  if (e.t < limits_.t_min) return "the format cannot hold so early a time; shift the times or write text";
  if (e.t >= limits_.t_end) return "the format cannot hold so late a time; shift the times or write text";
  if (e.t < previous_t_ && !limits_.back_steps) {
    return "the format cannot hold a time before that of the event before it; sort the events or write text";
  }
  return {};
}

std::string_view EventCheck::objection(const Trigger& trigger) const {
  if (limits_.trigger_inputs == 0) return "the format has no room for triggers";
  if (trigger.value > 1) return "its value must be 0 or 1";
  if (trigger.id >= limits_.trigger_inputs) return "the format does not tell so many inputs apart";
  if (trigger.t < limits_.t_min) return "the format cannot hold so early a time";
  if (trigger.t >= limits_.t_end) return "the format cannot hold so late a time";
  if (trigger.t < previous_t_ && !limits_.back_steps) {
    return "the format cannot hold a time before that of the event or trigger before it";
  }
  return {};
}

Result<void> EventCheck::accept(const std::string& path, const Trigger& trigger) {
  const std::string_view reason = objection(trigger);
  if (!reason.empty()) {
    return Error{ErrorCode::bad_input,
                 text(path, ": trigger ", triggers_, " (t ", trigger.t, ", id ", trigger.id, ", value ",
                      int{trigger.value}, ") cannot be written as ", limits_.format, ": ", reason)};
  }
  previous_t_ = trigger.t;
  ++triggers_;
  return {};
}

Result<void> EventCheck::accept_header(const std::string& path) const {
  if (limits_.header) return {};
  return Error{ErrorCode::bad_input,
               text(path, ": ", limits_.format, " has no room for the header of a camera")};
}

size_t EventCheck::accepted(std::span<const Event> events) {
  size_t good = 0;
  for (; good < events.size() && accepts(events[good]); ++good) previous_t_ = events[good].t;
  count_ += good;
  return good;
}

Error EventCheck::refusal(const std::string& path, const Event& e) const {
  return {ErrorCode::bad_input, text(path, ": event ", count_, " (t ", e.t, ", x ", e.x, ", y ", e.y, ", p ",
                                     int{e.p}, ") cannot be written as ", limits_.format, " for a sensor of ",
                                     size_text(sensor_), ": ", objection(e))};
}

}  // namespace scarf
