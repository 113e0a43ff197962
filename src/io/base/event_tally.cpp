#include "io/base/event_tally.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/sensor_size.h"

namespace scarf {

EventTally::EventTally(std::optional<SensorSize> sensor, const ReadOptions& options)
    : sensor_(sensor),
      time_policy_(options.time_policy),
      out_of_sensor_(options.out_of_sensor),
      time_shift_(options.time_shift),
      strict_(options.strict) {
  constexpr int32_t kEverything = std::numeric_limits<uint16_t>::max() + 1;
  limit_ = sensor.value_or(SensorSize{kEverything, kEverything});
}

size_t EventTally::keep(std::span<Event> events) {
  if (failure_) return 0;
  const size_t kept = is_plain(events) ? keep_all(events) : keep_by_policy(events);
  report.events += kept;
  return kept;
}

// Whether there is nothing for a policy to decide: no back-step, and all inside the sensor. Nearly every
// block is so, and this loop has neither a branch nor a store.
bool EventTally::is_plain(std::span<const Event> events) const {
  int64_t previous = previous_;
  bool in_order = true;
  int32_t margins = 0;  // negative once one of them was
  for (const Event& e : events) {
    in_order &= e.t >= previous;
    margins |= (limit_.width - 1 - e.x) | (limit_.height - 1 - e.y);
    previous = e.t;
  }
  return in_order && margins >= 0;
}

size_t EventTally::keep_all(std::span<Event> events) {
  if (events.empty()) return 0;
  // All steps lead forward, so none is longer than their sum.
  const int64_t begin = previous_ == kNoTime ? events.front().t : previous_;
  if (static_cast<uint64_t>(events.back().t) - static_cast<uint64_t>(begin) > kLongestStep) [[unlikely]] {
    for (const Event& e : events) {
      count_jump(e.t);
      previous_ = e.t;
    }
  }
  previous_ = events.back().t;
  if (time_shift_ == TimeShift::first_event && !shift_) set_shift(events.front().t);
  if (shift_) {
    for (Event& e : events) e.t -= *shift_;
  }
  return events.size();
}

size_t EventTally::keep_by_policy(std::span<Event> events) {
  size_t kept = 0;
  for (Event e : events) {
    const bool inside = limit_.contains(e);
    if (!inside && out_of_sensor_ == OutOfSensor::error) {
      fail({ErrorCode::bad_input,
            text("event ", report.events + report.outside + report.dropped + kept, " (t ", e.t, ", x ", e.x,
                 ", y ", e.y, ") is outside the sensor of ", size_text(limit_),
                 "; correct ReadOptions::sensor, or use ReadOptions::out_of_sensor drop")});
      break;
    }
    if (!in_order(e)) {
      if (failure_) break;
      ++report.dropped;
      continue;
    }
    if (!inside) {
      ++report.outside;
      continue;
    }
    if (time_shift_ == TimeShift::first_event && !shift_) set_shift(e.t);
    e.t -= shift_.value_or(0);
    events[kept++] = e;
  }
  return kept;
}

// Whether the time policy lets the event pass, perhaps with another time.
bool EventTally::in_order(Event& e) {
  if (e.t >= previous_) {
    count_jump(e.t);
    previous_ = e.t;
    return true;
  }
  count_back_step(e.t);
  switch (time_policy_) {
    case TimePolicy::keep:
      previous_ = e.t;
      return true;
    case TimePolicy::clamp:
      e.t = previous_;
      return true;
    case TimePolicy::drop:
      return false;
    case TimePolicy::error:
      break;
  }
  fail({ErrorCode::bad_input, text("an event at ", e.t, " us follows one at ", previous_,
                                   " us; use ReadOptions::time_policy keep, clamp or drop")});
  return false;
}

void EventTally::drop(int64_t t) {
  if (failure_) return;
  if (out_of_sensor_ == OutOfSensor::error) {
    fail({ErrorCode::bad_input,
          text("an event at ", t,
               " us has a coordinate that no sensor has; use ReadOptions::out_of_sensor drop")});
    return;
  }
  Event e;
  e.t = t;
  if (in_order(e))
    ++report.outside;
  else if (!failure_)
    ++report.dropped;
}

void EventTally::set_first_high(int64_t t) {
  if (time_shift_ == TimeShift::first_high && !shift_) set_shift(t);
}

void EventTally::set_shift(int64_t shift) {
  shift_ = shift;
  report.time_shift = shift;
}

void EventTally::leave_out_polarity(std::string_view unit, uint64_t place) {
  if (failure_) return;
  ++report.undefined_polarities;
  if (!strict_) return;
  fail({ErrorCode::bad_input, text(unit, " ", place,
                                   " holds an event whose polarity the format does not define; leave out "
                                   "ReadOptions::strict to pass over it")});
}

void EventTally::note_damage(uint64_t byte, std::string what) {
  if (strict_)
    fail({ErrorCode::bad_input,
          text("byte ", byte, ": ", what, "; leave out ReadOptions::strict to read the rest")});
  ++report.damages;
  if (!report.damage) report.damage = Damage{byte, std::move(what)};
}

void EventTally::fail(Error error) {
  if (!failure_) failure_ = std::move(error);
}

void EventTally::count_back_step(int64_t t) {
  // Unsigned: the distance of two hostile times may not fit a signed difference.
  const auto step = static_cast<int64_t>(static_cast<uint64_t>(previous_) - static_cast<uint64_t>(t));
  ++report.back_steps;
  report.largest_back_step = std::max(report.largest_back_step, step);
}

// Of an event at t, which is not before the one in front of it.
void EventTally::count_jump(int64_t t) {
  // Unsigned, as in count_back_step.
  const uint64_t step = static_cast<uint64_t>(t) - static_cast<uint64_t>(previous_);
  if (previous_ == kNoTime || step <= kLongestStep) return;
  ++report.jumps;
  if (step <= static_cast<uint64_t>(report.largest_jump)) return;
  report.largest_jump = static_cast<int64_t>(std::min<uint64_t>(step, std::numeric_limits<int64_t>::max()));
  report.largest_jump_from = previous_;
}

}  // namespace scarf
