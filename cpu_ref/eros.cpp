// EROS (exponential reduced ordinal surface), as defined: an event makes its pixel white and scales the
// others of its window by d^(1/k). Source: Gava et al., "PUCK: Parallel Surface and Convolution-kernel
// Tracking for Event-Based Cameras", 2022.
#include "cpu_ref/age_surface.h"
#include "cpu_ref/references.h"

namespace scarf {

Reference make_reference(const ErosParameters& parameters, SensorSize sensor) {
  return std::make_unique<AgeSurface>(sensor, parameters.kernel,
                                      eros_table(parameters.kernel, parameters.decay));
}

}  // namespace scarf
