#include "bench/published.h"

#include <array>
#include <cstddef>

namespace scarf::bench {
namespace {

constexpr std::array<SensorSize, 4> kSensors = {{{240, 180}, {346, 260}, {640, 480}, {1280, 720}}};
constexpr double kNone = 0;

// The paper gives both in microseconds.
struct InPaper {
  std::string_view representation;
  double event_us;
  double query_us;
};
constexpr InPaper kInPaper[] = {
    {"scarf", 0.070, 0.057},   {"sits", 0.217, 8.6},     {"tos", 0.096, 7.3}, {"eros", 0.084, 6.9},
    {"chain_sae", 0.026, 218}, {"aed_sae", 0.073, 2786}, {"aae", 0.033, 251}, {"time_window", 0.064, 0.060},
};

// One figure for each of kSensors.
struct Released {
  std::string_view representation;
  std::array<double, kSensors.size()> event_ns;
  std::array<double, kSensors.size()> query_us;
};
constexpr Released kReleased[] = {
    {"scarf", {90, 125, 225, 537}, {5, 10, 50, 239}},
    {"eros", {77, 77, 85, 102}, {}},
    {"tos", {54, 55, 63, 82}, {}},
    {"sits", {156, 159, 176, 292}, {}},
    {"chain_sae", {3.8, 4.4, 24, 30}, {337, 734, 21'000, 98'000}},
    {"aed_sae", {18, 20, 22, 26}, {940, 11'100, 8'600, 29'900}},
    {"aae", {8, 10, 21, 40}, {216, 274, 1'500, 9'200}},
};

constexpr Released kReleasedDefaultScarf = {"scarf", {35, 39, 65, 150}, {5, 10, 50, 239}};

std::optional<double> given(double value) {
  return value == kNone ? std::nullopt : std::optional(value);
}

PublishedCosts costs_on(SensorSize sensor, const Released& row) {
  for (size_t i = 0; i < kSensors.size(); ++i) {
    if (kSensors[i] == sensor) return {given(row.event_ns[i]), given(row.query_us[i])};
  }
  return {};
}

}  // namespace

PublishedCosts costs_in_paper(std::string_view representation, SensorSize sensor) {
  if (!(sensor == kSensors[0])) return {};
  for (const InPaper& row : kInPaper) {
    if (row.representation == representation) return {row.event_us * 1000, row.query_us};
  }
  return {};
}

PublishedCosts costs_of_released_code(std::string_view representation, SensorSize sensor) {
  for (const Released& row : kReleased) {
    if (row.representation == representation) return costs_on(sensor, row);
  }
  return {};
}

PublishedCosts costs_of_released_default_scarf(SensorSize sensor) {
  return costs_on(sensor, kReleasedDefaultScarf);
}

}  // namespace scarf::bench
