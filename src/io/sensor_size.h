// Sensor sizes in files and messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/text.h"
#include "scarf/event.h"
#include "scarf/geometry.h"
#include "scarf/result.h"

namespace scarf {

inline std::string size_text(SensorSize size) {
  return text(size.width, "x", size.height);
}

/// Errors: bad_input, naming `what` says so, unless both are 1..kMaxSensorSize.
inline Result<SensorSize> checked_sensor(int64_t width, int64_t height, std::string_view what) {
  const auto legal = [](int64_t v) { return v >= 1 && v <= kMaxSensorSize; };
  if (legal(width) && legal(height)) {
    return SensorSize{static_cast<int32_t>(width), static_cast<int32_t>(height)};
  }
  return Error{ErrorCode::bad_input, text(what, " says ", width, "x", height, ", but a sensor has 1 to ",
                                          kMaxSensorSize, " pixels per axis")};
}

}  // namespace scarf
