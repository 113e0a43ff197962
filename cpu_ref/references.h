// The references by their parameters, which are checked, and whose kernels are odd.
#pragma once

#include <memory>

#include "scarf/core/parameters.h"
#include "scarf/core/representation.h"

namespace scarf {

using Reference = std::unique_ptr<Representation>;

Reference make_reference(const TimeWindowParameters& parameters, SensorSize sensor);
Reference make_reference(const SaeParameters& parameters, SensorSize sensor);
Reference make_reference(const ErosParameters& parameters, SensorSize sensor);
Reference make_reference(const TosParameters& parameters, SensorSize sensor);
Reference make_reference(const SitsParameters& parameters, SensorSize sensor);
Reference make_reference(const ChainSaeParameters& parameters, SensorSize sensor);
Reference make_reference(const AedSaeParameters& parameters, SensorSize sensor);
Reference make_reference(const AaeParameters& parameters, SensorSize sensor);

}  // namespace scarf
