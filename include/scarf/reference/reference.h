// The CPU reference: the definition that every other implementation is compared with.
#pragma once

#include <memory>
#include <span>

#include "scarf/core/filter.h"
#include "scarf/core/parameters.h"
#include "scarf/core/patch_state.h"

namespace scarf {

/// A SCARF state on the CPU: one thread, plain loops. `accumulation` is c of the dense images.
/// Errors: illegal_parameter, as checked_geometry and make_levels.
Result<std::unique_ptr<Scarf>> make_reference_scarf(const Geometry& geometry,
                                                    double accumulation = kDefaultAccumulation);

/// Any representation on a sensor. Errors: illegal_parameter as checked_parameters, and for a sensor that the
/// representation cannot be on.
Result<std::unique_ptr<Representation>> make_reference_representation(const Parameters& parameters,
                                                                      SensorSize sensor);

/// A representation behind noise filters: it sees what passes all of them. Errors: illegal_parameter as
/// checked_filter.
Result<std::unique_ptr<Representation>> behind_filters(std::unique_ptr<Representation> representation,
                                                       std::span<const FilterParameters> filters);

}  // namespace scarf
