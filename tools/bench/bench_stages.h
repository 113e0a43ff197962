// The stages of SCARF in `scarf bench --stages`: their times beside what the device can do at most.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "bench/ceilings.h"
#include "bench/stages.h"

namespace scarf::tools {

/// Measures the stages of a stream whose parameters made it. `events`: as of measure_stages.
Result<std::vector<bench::StageFigure>> stage_figures(GpuContext& context, GpuScarf& scarf,
                                                      const ScarfParameters& parameters,
                                                      std::span<const Event> events);
void print_stages(std::span<const bench::StageFigure> figures, const bench::Ceilings& ceilings);
nlohmann::json stages_as_json(std::span<const bench::StageFigure> figures, const bench::Ceilings& ceilings);

}  // namespace scarf::tools
