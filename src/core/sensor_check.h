// Legal sensor sizes.
#pragma once

#include "core/text.h"
#include "scarf/core/patch_grid.h"

namespace scarf {

inline Result<void> check_sensor(SensorSize sensor) {
  const auto legal = [](int32_t size) { return size >= 1 && size <= kMaxSensorSize; };
  if (legal(sensor.width) && legal(sensor.height)) return {};
  return Error{ErrorCode::illegal_parameter, text("sensor is ", sensor.width, "x", sensor.height,
                                                  ", legal is 1 to ", kMaxSensorSize, " pixels per axis")};
}

}  // namespace scarf
