// Parameters and shapes of the encodings.
#include "scarf/encoding.h"

#include "core/fields.h"
#include "scarf/geometry.h"

namespace scarf {
namespace {

constexpr int64_t kLongest = 1'000'000'000;
constexpr int64_t kMaxRadius = 16;

}  // namespace

template <class Visit>
void visit_fields(VoxelGridParameters& p, Visit visit) {
  visit(number_field("bins", 1, 256, "slices of time"), p.bins);
  visit(choice_field("convention", {"e2vid", "eventgan"}, "ON minus OFF, or planes of their own"),
        p.convention);
}

template <class Visit>
void visit_fields(ToreParameters& p, Visit visit) {
  visit(number_field("k", 1, 64, "newest events kept per pixel and polarity"), p.k);
}

template <class Visit>
void visit_fields(EventImageParameters&, Visit) {}

template <class Visit>
void visit_fields(TimeSurfaceParameters& p, Visit visit) {
  visit(time_field("tau", 1, kLongest, "time constant"), p.tau);
}

template <class Visit>
void visit_fields(HatsParameters& p, Visit visit) {
  visit(number_field("cell", 1, kMaxSensorSize, "pixels per side of a cell"), p.cell);
  visit(number_field("radius", 0, kMaxRadius, "reach of a time surface in pixels"), p.radius);
  visit(time_field("tau", 1, kLongest, "time constant"), p.tau);
  visit(time_field("window", 1, kLongest, "events older than this are forgotten"), p.window);
}

template <class Visit>
void visit_fields(HotsParameters& p, Visit visit) {
  visit(number_field("cell", 1, kMaxSensorSize, "pixels per side of a cell"), p.cell);
  visit(number_field("radius", 0, kMaxRadius, "reach of a time surface in pixels"), p.radius);
  visit(time_field("tau", 1, kLongest, "time constant"), p.tau);
}

namespace {

template <class Parameters>
EncodingInfo info(std::string name, std::string title, std::string description, bool cpu_only = false) {
  return {std::move(name), std::move(title), std::move(description), describe_fields<Parameters>(), cpu_only};
}

// The encoding of a name with parameters from words; tries the alternatives one after the other.
template <size_t kIndex = 0>
Result<EncodingParameters> read(const NamedWords& parts) {
  if constexpr (kIndex == std::variant_size_v<EncodingParameters>) {
    std::vector<std::string> known;
    for (const EncodingInfo& each : encodings()) known.push_back(each.name);
    return unknown_name("encoding", parts.name, known);
  } else {
    if (parts.name != encodings()[kIndex].name) return read<kIndex + 1>(parts);
    using Parameters = std::variant_alternative_t<kIndex, EncodingParameters>;
    const auto parameters = read_fields<Parameters>("encoding " + parts.name, parts.words);
    if (!parameters) return parameters.error();
    return EncodingParameters(*parameters);
  }
}

int32_t ceil_div(int32_t a, int32_t b) {
  return (a + b - 1) / b;
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
  const auto parts = split_words("encoding", words);
  if (!parts) return parts.error();
  return read(*parts);
}

Result<EncodingParameters> checked_encoding(const EncodingParameters& parameters) {
  const std::string subject = "encoding " + info_of(parameters).name;
  const auto result = std::visit([&](const auto& p) { return check_fields(subject, p); }, parameters);
  if (!result) return result.error();
  return parameters;
}

EncodingShape shape_of(const EncodingParameters& parameters, SensorSize sensor) {
  return std::visit(Shape{sensor}, parameters);
}

}  // namespace scarf
