// Sensor sizes in files and messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/text.h"
#include "scarf/core/event.h"
#include "scarf/core/patch_grid.h"
#include "scarf/core/result.h"

namespace scarf {

inline std::string size_text(SensorSize size) {
  return text(size.width, "x", size.height);
}

/// Errors: bad_input, naming `what` says so, unless both are 1..kMaxSensorSize.
Result<SensorSize> checked_sensor(int64_t width, int64_t height, std::string_view what);

/// The sensor that a file and the caller agree on; nullopt if neither says. Errors: bad_input, naming both
/// sizes if they differ; illegal_parameter if `given` is no legal size.
Result<std::optional<SensorSize>> agreed_sensor(std::optional<SensorSize> file,
                                                std::optional<SensorSize> given);

}  // namespace scarf
