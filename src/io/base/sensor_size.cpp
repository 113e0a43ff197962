#include "io/base/sensor_size.h"

namespace scarf {

Result<SensorSize> checked_sensor(int64_t width, int64_t height, std::string_view what) {
  const auto legal = [](int64_t v) { return v >= 1 && v <= kMaxSensorSize; };
  if (legal(width) && legal(height)) {
    return SensorSize{static_cast<int32_t>(width), static_cast<int32_t>(height)};
  }
  return Error{ErrorCode::bad_input, text(what, " says ", width, "x", height, ", but a sensor has 1 to ",
                                          kMaxSensorSize, " pixels per axis")};
}

Result<std::optional<SensorSize>> agreed_sensor(std::optional<SensorSize> file,
                                                std::optional<SensorSize> given) {
  if (given) {
    const auto legal = checked_sensor(given->width, given->height, "the sensor size given");
    if (!legal) return Error{ErrorCode::illegal_parameter, legal.error().message};
  }
  if (file && given && *file != *given) {
    return Error{ErrorCode::bad_input, text("the file's sensor is ", size_text(*file), ", but ",
                                            size_text(*given), " was given; leave it out or correct it")};
  }
  return file ? file : given;
}

}  // namespace scarf
