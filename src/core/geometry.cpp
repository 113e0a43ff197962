// The presets and the legal ranges of patch grids.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/ceil_div.h"
#include "core/text.h"
#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

constexpr int32_t kDefaultCell = 9;
constexpr double kDefaultRatio = 1.2;
constexpr double kDefaultAlpha = 2.0;

constexpr std::array<std::pair<Preset, std::string_view>, 5> kPresetNames = {{
    {Preset::paper, "paper"},
    {Preset::light, "light"},
    {Preset::event_driven, "event_driven"},
    {Preset::event_driven_flex, "event_driven_flex"},
    {Preset::explicit_, "explicit"},
}};

int32_t floor_div(int32_t a, int32_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

Error illegal(const std::string& what) {
  return {ErrorCode::illegal_parameter, what};
}

Error out_of_range(std::string_view name, double value, std::string_view range) {
  return illegal(text(name, " is ", value, ", legal is ", range));
}

// A product of parameters as an integer; nullopt where it would not fit an int32 (then no range check
// passes).
std::optional<int32_t> integer(double rounded) {
  if (!(std::abs(rounded) <= 2e9)) return std::nullopt;
  return static_cast<int32_t>(rounded);
}

struct Parameters {
  int32_t k;
  double r;
  double alpha;
};

Result<Parameters> checked_parameters(Preset preset, const PresetParameters& given) {
  const bool uses_ratio = preset == Preset::paper || preset == Preset::event_driven_flex;
  if (given.ratio && !uses_ratio) {
    return illegal(text("ratio ", *given.ratio, " given, but preset ", preset_name(preset),
                        " does not use a ratio; leave it out, or use paper or event_driven_flex"));
  }
  const Parameters p = {given.cell.value_or(kDefaultCell), given.ratio.value_or(kDefaultRatio),
                        given.alpha.value_or(kDefaultAlpha)};
  if (p.k < 1 || p.k > kMaxField) return out_of_range("cell", p.k, "1 to 128");
  if (!std::isfinite(p.r) || p.r < 0) return out_of_range("ratio", p.r, "a finite number >= 0");
  if (!std::isfinite(p.alpha) || p.alpha <= 0) return out_of_range("alpha", p.alpha, "a finite number > 0");
  return p;
}

// Cells of k pixels from the sensor's corner on, the last row and column partial.
GridAxis full_coverage(int32_t size, int32_t k, int32_t margin_lo, int32_t margin_hi) {
  return {size, k, 0, ceil_div(size, k), margin_lo, margin_hi};
}

Result<Geometry> with_capacity(GridAxis x, GridAxis y, double capacity, const Parameters& p) {
  const auto n = integer(std::floor(capacity));
  if (!n || *n < 1 || *n > kMaxCapacity) {
    return illegal(text("capacity from cell ", p.k, ", ratio ", p.r, ", alpha ", p.alpha, " is ",
                        std::floor(capacity), ", legal is 1 to 65535; change alpha or ratio"));
  }
  return checked_geometry({x, y, *n});
}

Result<Geometry> paper(SensorSize sensor, const Parameters& p) {
  const auto reach = integer(std::ceil(p.k * p.r));
  if (!reach || *reach < 1 || *reach > kMaxField) {
    return illegal(text("ratio ", p.r, " with cell ", p.k, " reaches ", std::ceil(p.k * p.r),
                        " pixels beyond the cell; legal is at least 1 and a field of at most 128 pixels"));
  }
  return with_capacity(full_coverage(sensor.width, p.k, *reach - 1, *reach),
                       full_coverage(sensor.height, p.k, *reach - 1, *reach),
                       p.alpha * ((p.k * p.r) * (p.k * p.r)), p);
}

Result<Geometry> light(SensorSize sensor, const Parameters& p) {
  return with_capacity(full_coverage(sensor.width, p.k, p.k / 2, p.k / 2),
                       full_coverage(sensor.height, p.k, p.k / 2, p.k / 2), p.alpha * p.k * p.k / 2.0, p);
}

Result<Geometry> event_driven(SensorSize sensor, const Parameters& p) {
  const int32_t k = p.k + p.k % 2;
  if (sensor.width < 2 * k || sensor.height < 2 * k) {
    return illegal(text("sensor ", sensor.width, "x", sensor.height,
                        " is too small for preset event_driven with cell ", k, ": the smallest is ", 2 * k,
                        "x", 2 * k));
  }
  const auto axis = [k](int32_t size) -> GridAxis {
    const int32_t count = size / k - 1;
    const int32_t even = size / (count + 1) / 2 * 2;
    return {size, even, even / 2, count, even / 2, even / 2};
  };
  const GridAxis x = axis(sensor.width);
  const GridAxis y = axis(sensor.height);
  return with_capacity(x, y, x.cell * y.cell * p.alpha * 0.5, p);
}

Result<Geometry> event_driven_flex(SensorSize sensor, const Parameters& p) {
  if (sensor.width < p.k || sensor.height < p.k) {
    return illegal(text("sensor ", sensor.width, "x", sensor.height,
                        " is too small for preset event_driven_flex with cell ", p.k, ": the smallest is ",
                        p.k, "x", p.k));
  }
  const auto axis = [&p](int32_t size) -> std::optional<GridAxis> {
    const int32_t count = size / p.k;
    const int32_t cell = size / count;
    const auto margin = integer(std::floor(cell * p.r));
    if (!margin || *margin > kMaxField) return std::nullopt;
    return GridAxis{size, cell, 0, count, *margin, *margin};
  };
  const auto x = axis(sensor.width);
  const auto y = axis(sensor.height);
  if (!x || !y) {
    return illegal(text("ratio ", p.r, " with cell ", p.k,
                        " makes a field of more than 128 pixels; legal is at most 128"));
  }
  return with_capacity(*x, *y, x->cell * (1 + p.r) * y->cell * (1 + p.r) * p.alpha / 4.5, p);
}

Result<void> check_axis(const GridAxis& a, std::string_view axis) {
  const auto range = [&](std::string_view field, int64_t value, int64_t low, int64_t high) -> Result<void> {
    if (value >= low && value <= high) return {};
    return illegal(text(field, " ", axis, " is ", value, ", legal is ", low, " to ", high));
  };
  if (auto r = range("sensor size", a.size, 1, kMaxSensorSize); !r) return r;
  if (auto r = range("cell", a.cell, 1, kMaxField); !r) return r;
  if (auto r = range("grid", a.grid, 1, 3 * kMaxSensorSize); !r) return r;
  if (auto r = range("margin_lo", a.margin_lo, 0, kMaxField); !r) return r;
  if (auto r = range("margin_hi", a.margin_hi, 0, kMaxField); !r) return r;
  if (auto r = range("receptive field", a.field(), 1, kMaxField); !r) return r;
  if (auto r = range("origin", a.origin, -kMaxSensorSize, a.size - 1 + kMaxSensorSize); !r) return r;
  const int64_t end = a.origin + int64_t{a.grid} * a.cell;
  return range("end of the last active region (origin + grid * cell)", end, -kMaxSensorSize + 1,
               a.size + kMaxSensorSize);
}

}  // namespace

PatchRange GridAxis::patches_holding(int32_t v) const {
  // Patch i holds v iff origin + i*cell - margin_lo <= v < origin + (i+1)*cell + margin_hi; solved for i.
  return {std::max(0, floor_div(v - origin - cell - margin_hi, cell) + 1),
          std::min(grid - 1, floor_div(v - origin + margin_lo, cell))};
}

Result<Geometry> make_geometry(Preset preset, SensorSize sensor, const PresetParameters& parameters) {
  return as_result([&]() -> Result<Geometry> {
    for (const auto& [name, value] : {std::pair{"width", sensor.width}, std::pair{"height", sensor.height}}) {
      if (value < 1 || value > kMaxSensorSize)
        return out_of_range(text("sensor ", name), value, "1 to 16384");
    }
    const auto p = checked_parameters(preset, parameters);
    if (!p) return p.error();
    switch (preset) {
      case Preset::paper:
        return paper(sensor, *p);
      case Preset::light:
        return light(sensor, *p);
      case Preset::event_driven:
        return event_driven(sensor, *p);
      case Preset::event_driven_flex:
        return event_driven_flex(sensor, *p);
      case Preset::explicit_:
        break;
    }
    return illegal("preset explicit needs its thirteen integers: pass them to checked_geometry");
  });
}

Result<Geometry> checked_geometry(const Geometry& geometry) {
  return as_result([&]() -> Result<Geometry> {
    if (auto r = check_axis(geometry.x, "x"); !r) return r.error();
    if (auto r = check_axis(geometry.y, "y"); !r) return r.error();
    if (geometry.capacity < 1 || geometry.capacity > kMaxCapacity) {
      return out_of_range("capacity", geometry.capacity, "1 to 65535");
    }
    return geometry;
  });
}

std::string_view preset_name(Preset preset) {
  for (const auto& [value, name] : kPresetNames) {
    if (value == preset) return name;
  }
  return "unknown";
}

Result<Preset> preset_from_name(std::string_view name) {
  return as_result([&]() -> Result<Preset> {
    std::string names;
    for (const auto& [value, known] : kPresetNames) {
      if (known == name) return value;
      names += (names.empty() ? "" : ", ") + std::string(known);
    }
    return illegal(text("preset '", name, "' is unknown; use one of ", names));
  });
}

std::string to_string(const Geometry& g) {
  const auto pair = [](int32_t x, int32_t y, char separator) { return text(x, separator, y); };
  return text("sensor ", pair(g.x.size, g.y.size, 'x'), " cell ", pair(g.x.cell, g.y.cell, 'x'), " origin ",
              pair(g.x.origin, g.y.origin, ','), " grid ", pair(g.x.grid, g.y.grid, 'x'), " margin_lo ",
              pair(g.x.margin_lo, g.y.margin_lo, ','), " margin_hi ", pair(g.x.margin_hi, g.y.margin_hi, ','),
              " capacity ", g.capacity);
}

}  // namespace scarf
