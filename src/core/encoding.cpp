// Parameters and shapes of the encodings.
#include "scarf/core/encoding.h"

#include "core/ceil_div.h"
#include "core/fields.h"
#include "scarf/core/patch_grid.h"

namespace scarf {
namespace {

constexpr int64_t kLongest = 1'000'000'000;
constexpr int32_t kMaxRadius = 16;

}  // namespace

template <class Visit>
void fields(VoxelGridParameters& p, Visit visit) {
  visit(between("bins", p.bins, 1, 256, "slices of time"));
  visit(choice("convention", p.convention, {"e2vid", "eventgan"}, "ON minus OFF, or planes of their own"));
}

template <class Visit>
void fields(ToreParameters& p, Visit visit) {
  visit(between("k", p.k, 1, 64, "newest events kept per pixel and polarity"));
}

template <class Visit>
void fields(EventImageParameters&, Visit) {}

template <class Visit>
void fields(TimeSurfaceParameters& p, Visit visit) {
  visit(between("tau", p.tau, 1, kLongest, "time constant"));
}

template <class Visit>
void fields(HatsParameters& p, Visit visit) {
  visit(between("cell", p.cell, 1, kMaxSensorSize, "pixels per side of a cell"));
  visit(between("radius", p.radius, 0, kMaxRadius, "reach of a time surface in pixels"));
  visit(between("tau", p.tau, 1, kLongest, "time constant"));
  visit(between("window", p.window, 1, kLongest, "events older than this are forgotten"));
}

template <class Visit>
void fields(HotsParameters& p, Visit visit) {
  visit(between("cell", p.cell, 1, kMaxSensorSize, "pixels per side of a cell"));
  visit(between("radius", p.radius, 0, kMaxRadius, "reach of a time surface in pixels"));
  visit(between("tau", p.tau, 1, kLongest, "time constant"));
}

namespace {

template <class P>
EncodingInfo info(std::string name, std::string title, std::string description, bool cpu_only = false) {
  return {std::move(name), std::move(title), std::move(description), describe_fields<P>(), cpu_only};
}

// Planes of one polarity: the neighbours of a pixel.
int32_t neighbours(int32_t radius) {
  return (2 * radius + 1) * (2 * radius + 1);
}

struct Shape {
  SensorSize sensor;

  EncodingShape pixels(int32_t planes) const { return {planes, sensor.height, sensor.width}; }
  EncodingShape cells(int32_t planes, int32_t cell) const {
    return {planes, ceil_div(sensor.height, cell), ceil_div(sensor.width, cell)};
  }

  EncodingShape operator()(const VoxelGridParameters& p) const {
    return pixels(p.convention == VoxelGridParameters::Convention::eventgan ? 2 * p.bins : p.bins);
  }
  EncodingShape operator()(const ToreParameters& p) const { return pixels(2 * p.k); }
  EncodingShape operator()(const EventImageParameters&) const { return pixels(4); }
  EncodingShape operator()(const TimeSurfaceParameters&) const { return pixels(2); }
  EncodingShape operator()(const HatsParameters& p) const { return cells(2 * neighbours(p.radius), p.cell); }
  EncodingShape operator()(const HotsParameters& p) const { return cells(2 * neighbours(p.radius), p.cell); }
};

}  // namespace

std::span<const EncodingInfo> encodings() {
  static const std::vector<EncodingInfo> infos = {
      info<VoxelGridParameters>("voxel_grid", "VoxelGrid", "events split linearly over bins of time"),
      info<ToreParameters>("tore", "TORE", "logarithms of the newest ages per pixel and polarity"),
      info<EventImageParameters>("event_image", "EV-FlowNet",
                                 "number and last time of the events per polarity"),
      info<TimeSurfaceParameters>("time_surface", "time surface",
                                  "exponential decay since the last event per polarity"),
      info<HatsParameters>("hats", "HATS", "histograms of averaged time surfaces, per cell",
                           /*cpu_only=*/true),
      info<HotsParameters>("hots", "HOTS", "time surfaces averaged over the events of a cell",
                           /*cpu_only=*/true),
  };
  return infos;
}

const EncodingInfo& info_of(const EncodingParameters& parameters) {
  return encodings()[parameters.index()];
}

Result<EncodingParameters> parse_encoding(const std::string& words) {
  return as_result([&]() -> Result<EncodingParameters> {
    const auto named = split_words("encoding", words);
    if (!named) return named.error();
    const auto parameters = read_alternative<EncodingParameters>("encoding", encodings(), *named);
    return parameters ? checked_encoding(*parameters) : parameters;
  });
}

Result<EncodingParameters> checked_encoding(const EncodingParameters& parameters) {
  return as_result([&]() -> Result<EncodingParameters> { return checked_alternative(parameters); });
}

EncodingShape shape_of(const EncodingParameters& parameters, SensorSize sensor) {
  return std::visit(Shape{sensor}, parameters);
}

}  // namespace scarf
