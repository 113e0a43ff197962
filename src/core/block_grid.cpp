#include "core/block_grid.h"

#include "core/ceil_div.h"

namespace scarf {

BlockGrid block_grid(const AaeParameters& parameters, SensorSize sensor) {
  constexpr int32_t kEsvo2Columns = 8;
  constexpr int32_t kEsvo2Rows = 6;
  if (parameters.esvo2) {
    return {{ceil_div(sensor.width, kEsvo2Columns), ceil_div(sensor.height, kEsvo2Rows)},
            kEsvo2Columns,
            kEsvo2Rows};
  }
  const int32_t size = parameters.block;
  return {{size, size},
          static_cast<uint32_t>(ceil_div(sensor.width, size)),
          static_cast<uint32_t>(ceil_div(sensor.height, size))};
}

}  // namespace scarf
