// The reference of any representation.
#include "core/sensor_check.h"
#include "cpu_ref/references.h"
#include "scarf/reference/reference.h"

namespace scarf {
namespace {

Result<Reference> make_checked(const ScarfParameters& parameters, SensorSize sensor) {
  const auto geometry = make_geometry(parameters.preset, sensor, parameters.grid);
  if (!geometry) return geometry.error();
  auto scarf = make_reference_scarf(*geometry, parameters.accumulation);
  if (!scarf) return scarf.error();
  return Reference(std::move(*scarf));
}

template <class T>
Result<Reference> make_checked(const T& parameters, SensorSize sensor) {
  return make_reference(parameters, sensor);
}

}  // namespace

Result<std::unique_ptr<Representation>> make_reference_representation(const Parameters& parameters,
                                                                      SensorSize sensor) {
  return as_result([&]() -> Result<std::unique_ptr<Representation>> {
    const auto checked = checked_parameters(parameters);
    if (!checked) return checked.error();
    if (auto r = check_sensor(sensor); !r) return r.error();
    return std::visit([sensor](const auto& p) { return make_checked(p, sensor); }, *checked);
  });
}

}  // namespace scarf
