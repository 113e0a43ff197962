// TOS (threshold ordinal surface), as defined: an event makes its pixel white, takes 1 from the others of its
// window, and makes those black that fall below 255 - k * decay. Source: Glover et al., "luvHarris: A
// Practical Corner Detector for Event-Cameras", 2021.
#include "cpu_ref/age_surface.h"
#include "cpu_ref/references.h"

namespace scarf {

Reference make_reference(const TosParameters& parameters, SensorSize sensor) {
  return std::make_unique<AgeSurface>(sensor, parameters.kernel,
                                      tos_table(parameters.kernel, parameters.decay));
}

}  // namespace scarf
