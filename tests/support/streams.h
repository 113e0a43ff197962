// Random event streams for tests, by how they are spread over the sensor.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "scarf/core/patch_grid.h"

namespace scarf::test {

enum class Spread { uniform, moving_edge, one_pixel, one_row, corners, alternating, border, beyond };
inline constexpr Spread kSpreads[] = {Spread::uniform, Spread::moving_edge, Spread::one_pixel,
                                      Spread::one_row, Spread::corners,     Spread::alternating,
                                      Spread::border,  Spread::beyond};

/// Events with small steps of time, some of them back; Spread::beyond puts half of them outside the sensor.
inline std::vector<Event> make_stream(Spread spread, SensorSize sensor, size_t count, uint64_t seed,
                                      int64_t t_begin = 0) {
  std::mt19937 random(static_cast<uint32_t>(seed));
  const auto below = [&](int32_t n) { return static_cast<int32_t>(random() % static_cast<uint32_t>(n)); };
  std::vector<Event> events(count);
  int64_t t = t_begin;
  for (size_t i = 0; i < count; ++i) {
    t += below(5) - 1;
    int32_t x = below(sensor.width);
    int32_t y = below(sensor.height);
    const bool flip = below(2) == 1;
    switch (spread) {
      case Spread::uniform:
        break;
      case Spread::moving_edge:
        x = (y / 3 + static_cast<int32_t>(i * 40 / count) + below(2)) % sensor.width;
        break;
      case Spread::one_pixel:
        x = sensor.width / 2;
        y = sensor.height / 2;
        break;
      case Spread::one_row:
        y = sensor.height / 3;
        break;
      case Spread::corners:
        x = flip ? 0 : sensor.width - 1;
        y = below(2) == 1 ? 0 : sensor.height - 1;
        break;
      case Spread::alternating:
        x = i % 2 == 0 ? 0 : sensor.width - 1;
        break;
      case Spread::border:
        (flip ? x : y) = 0;
        break;
      case Spread::beyond:
        if (flip) x = sensor.width + below(65'536 - sensor.width);
        break;
    }
    events[i] = {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), static_cast<uint8_t>(below(2)), {}};
  }
  return events;
}

/// Any legal geometry on a sensor: cells of 3..13 pixels, margins up to 1.5 cells, origins in and out of the
/// sensor, rings of 1..300 slots.
inline Geometry random_geometry(SensorSize sensor, std::mt19937& random) {
  const auto from = [&](int32_t low, int32_t high) {
    return low + static_cast<int32_t>(random() % static_cast<uint32_t>(high - low + 1));
  };
  const auto axis = [&](int32_t size) {
    GridAxis a;
    a.size = size;
    a.cell = from(3, 13);
    a.origin = from(-2 * a.cell, a.cell);
    a.grid = from(1, size / a.cell + 2);
    a.margin_lo = from(0, a.cell * 3 / 2);
    a.margin_hi = from(0, a.cell * 3 / 2);
    return a;
  };
  const GridAxis x = axis(sensor.width);
  const GridAxis y = axis(sensor.height);
  return {x, y, from(1, 4) == 1 ? from(1, 3) : from(1, 300)};
}

}  // namespace scarf::test
