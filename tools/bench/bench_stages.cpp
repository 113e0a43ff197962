#include "tools/bench/bench_stages.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "scarf/core/image.h"

namespace scarf::tools {
namespace {

double copy_fraction(const bench::StageFigure& figure, const bench::Ceilings& ceilings) {
  return *figure.bytes_per_event / (figure.ns_per_event * 1e-9) / ceilings.copy_bytes_per_s;
}

double atomic_fraction(const bench::StageFigure& figure, const bench::Ceilings& ceilings) {
  return figure.atomics_per_event / (figure.ns_per_event * 1e-9) / ceilings.atomics_per_s;
}

}  // namespace

Result<std::vector<bench::StageFigure>> stage_figures(GpuContext& context, GpuScarf& scarf,
                                                      const ScarfParameters& parameters,
                                                      std::span<const Event> events) {
  const auto levels = make_levels(parameters.accumulation, scarf.geometry().capacity);
  if (!levels) return levels.error();
  const auto plan = make_plan(scarf.geometry(), levels->u8, context.vulkan().limits(), {});
  if (!plan) return plan.error();
  return bench::measure_stages(scarf, *plan, events);
}

void print_stages(std::span<const bench::StageFigure> figures, const bench::Ceilings& ceilings) {
  std::printf("    %-10s %10s %10s %7s %10s %8s %10s %10s %11s\n", "stage", "dispatches", "ns/event", "time",
              "B/event", "GB/s", "of copies", "atomics/ev", "of atomics");
  double sum = 0;
  for (const bench::StageFigure& figure : figures) sum += figure.ns_per_event;
  for (const bench::StageFigure& figure : figures) {
    std::printf("    %-10s %10lu %10.3f %6.1f%%", figure.stage.c_str(),
                static_cast<unsigned long>(figure.dispatches), figure.ns_per_event,
                figure.ns_per_event / sum * 100);
    if (figure.bytes_per_event) {
      std::printf(" %10.2f %8.2f %9.1f%%", *figure.bytes_per_event,
                  *figure.bytes_per_event / figure.ns_per_event, copy_fraction(figure, ceilings) * 100);
    }
    if (figure.atomics_per_event > 0) {
      std::printf(" %10.2f %10.1f%%", figure.atomics_per_event, atomic_fraction(figure, ceilings) * 100);
    }
    std::printf("\n");
  }
}

nlohmann::json stages_as_json(std::span<const bench::StageFigure> figures, const bench::Ceilings& ceilings) {
  nlohmann::json stages = nlohmann::json::array();
  for (const bench::StageFigure& figure : figures) {
    nlohmann::json stage = {
        {"stage", figure.stage}, {"dispatches", figure.dispatches}, {"ns_per_event", figure.ns_per_event}};
    if (figure.bytes_per_event) {
      stage["bytes_per_event"] = *figure.bytes_per_event;
      stage["copy_fraction"] = copy_fraction(figure, ceilings);
    }
    if (figure.atomics_per_event > 0) {
      stage["atomics_per_event"] = figure.atomics_per_event;
      stage["atomic_fraction"] = atomic_fraction(figure, ceilings);
    }
    stages.push_back(stage);
  }
  return stages;
}

}  // namespace scarf::tools
