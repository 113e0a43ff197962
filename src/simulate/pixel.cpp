#include "simulate/pixel.h"

#include <cmath>

#include "simulate/logarithm.h"

namespace scarf::simulate {

std::vector<int32_t> log_table() {
  std::vector<int32_t> table(65'536);
  for (size_t i = 0; i < table.size(); ++i) {
    // One more, so that black has a logarithm too.
    table[i] = static_cast<int32_t>(std::nearbyint(natural_log(static_cast<double>(i + 1)) * kLogUnit));
  }
  return table;
}

}  // namespace scarf::simulate
