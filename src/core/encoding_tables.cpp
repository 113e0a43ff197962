#include "core/encoding_tables.h"

#include <algorithm>
#include <cmath>

namespace scarf {

float tore_value(uint64_t age) {
  const auto d = static_cast<double>(std::min<uint64_t>(age, kToreOldest));
  return static_cast<float>(std::max(0.0, std::log(d + 1) - std::log(kToreNewest + 1.0)));
}

std::vector<float> tore_table() {
  std::vector<float> table;
  table.reserve(kToreOldest + 1);
  for (uint64_t age = 0; age <= kToreOldest; ++age) table.push_back(tore_value(age));
  return table;
}

int64_t decay_weight(uint64_t age, int64_t tau) {
  const double value = std::exp(-static_cast<double>(age) / static_cast<double>(tau));
  // llrint rounds half to even in the default rounding mode.
  return std::llrint(value * static_cast<double>(kWeightOne));
}

}  // namespace scarf
