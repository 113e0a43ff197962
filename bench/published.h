// What others measured, to be shown beside our figures.
#pragma once

#include <optional>
#include <string_view>

#include "scarf/core/event.h"

namespace scarf::bench {

struct PublishedCosts {
  std::optional<double> ns_per_event;
  std::optional<double> query_us;
};

/// The cost table of the paper: 240x180, dynamic_6dof. Empty for other sensors and representations.
PublishedCosts costs_in_paper(std::string_view representation, SensorSize sensor);

/// The paper's released code (robotology/event-driven), run by us: one thread of a 2-core machine,
/// -O3 -march=native, queries at 100 Hz, synthetic edges. SCARF with fields of r = 1.2, as the preset paper.
PublishedCosts costs_of_released_code(std::string_view representation, SensorSize sensor);
/// The same with the fields that the released SCARF has by default (k = 9, cells of 10 pixels, alpha = 2).
PublishedCosts costs_of_released_default_scarf(SensorSize sensor);

}  // namespace scarf::bench
