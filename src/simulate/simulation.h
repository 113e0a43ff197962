// The simulation of any scene, for the named scenes and for tests.
#pragma once

#include <memory>

#include "scarf/simulate/simulate.h"
#include "simulate/scene.h"

namespace scarf::simulate {

/// The options must be legal; their scene is not looked at.
std::unique_ptr<Simulation> simulate_scene(const SimulationOptions& options, Scene scene);

}  // namespace scarf::simulate
