#include "core/batch_check.h"

#include <algorithm>

#include "core/text.h"

namespace scarf {
namespace {

Error refusal(std::span<const Event> events, size_t index, int64_t t_first) {
  const Event& e = events[index];
  const std::string name =
      text("event ", index, " of the batch (t ", e.t, ", x ", e.x, ", y ", e.y, ", p ", int{e.p}, ")");
  if (e.p > 1)
    return {ErrorCode::refused_batch, text(name, ": the polarity must be 0 or 1; the batch was not stored")};
  return {ErrorCode::refused_batch,
          text(name, " is 2^48 us or more away from the stream's first event at t ", t_first,
               "; the batch was not stored: correct the times, or reset and start a new stream")};
}

}  // namespace

Result<CheckedBatch> check_batch(std::span<const Event> events, SensorSize sensor,
                                 std::optional<int64_t> t_first) {
  CheckedBatch batch;
  batch.t_first = t_first;
  size_t i = 0;
  for (; i < events.size() && !batch.t_first; ++i) {
    if (sensor.contains(events[i]))
      batch.t_first = events[i].t;
    else
      ++batch.outside;
  }
  if (!batch.t_first) return batch;
  // |t - t_first| < 2^48, as a range of times that ends where 64 bits end.
  constexpr auto kReach = static_cast<int64_t>(kMaxTimeDistance - 1);
  const int64_t earliest = *batch.t_first < INT64_MIN + kReach ? INT64_MIN : *batch.t_first - kReach;
  const int64_t latest = *batch.t_first > INT64_MAX - kReach ? INT64_MAX : *batch.t_first + kReach;
  int64_t newest = 0;
  int64_t largest = INT64_MIN;
  uint64_t inside_count = 0;
  const size_t begin = i > 0 ? i - 1 : 0;
  for (i = begin; i < events.size(); ++i) {
    const Event& e = events[i];
    const bool inside = sensor.contains(e);
    const bool storable = e.p <= 1 && e.t >= earliest && e.t <= latest;
    if (inside && !storable) return refusal(events, i, *batch.t_first);
    if (!inside) continue;
    ++inside_count;
    newest = e.t;
    largest = std::max(largest, e.t);
  }
  batch.outside += events.size() - begin - inside_count;
  if (inside_count > 0) {
    batch.t_newest = newest;
    batch.t_largest = largest;
  }
  return batch;
}

}  // namespace scarf
