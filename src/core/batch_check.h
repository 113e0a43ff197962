// What every implementation asks of a batch before it stores anything of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf {

/// Times are stored as 49-bit differences to the stream's first event.
inline constexpr uint64_t kMaxTimeDistance = uint64_t{1} << 48;

struct CheckedBatch {
  uint64_t outside = 0;             ///< events outside the sensor
  std::optional<int64_t> t_first;   ///< of the stream's first event inside the sensor, if there is one by now
  std::optional<int64_t> t_newest;  ///< of this batch's last event inside the sensor, if there is one
  std::optional<int64_t> t_largest;  ///< of this batch's events inside the sensor
};

/// Checks a batch against a stream whose first event was at `t_first` (nullopt: no event yet).
/// Errors: refused_batch, naming the first offending event.
Result<CheckedBatch> check_batch(std::span<const Event> events, SensorSize sensor,
                                 std::optional<int64_t> t_first);

}  // namespace scarf
