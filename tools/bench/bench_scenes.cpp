// scarf bench without --paper: pushes of synthetic scenes, with an image after each.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/push.h"
#include "bench/scenes.h"
#include "core/text.h"
#include "scarf/reference/reference.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_stages.h"

namespace scarf::tools {
namespace {

constexpr SensorSize kSensors[] = {{240, 180}, {346, 260}, {640, 480}, {1280, 720}};
constexpr Preset kPresets[] = {Preset::paper, Preset::light};

// What one line of the table is about.
struct Variant {
  std::string name;  ///< for people: a preset of scarf, or a representation
  std::string preset;
  Parameters parameters;
};

Result<std::vector<Variant>> variants(const BenchOptions& options) {
  std::vector<Variant> all;
  if (options.representation.empty()) {
    for (const Preset preset : kPresets) {
      const std::string name(preset_name(preset));
      all.push_back({name, name, ScarfParameters{.preset = preset, .grid = {}}});
    }
    return all;
  }
  const auto parameters = parse_parameters(options.representation, options.parameters);
  if (!parameters) return parameters.error();
  const auto* scarf = std::get_if<ScarfParameters>(&*parameters);
  const std::string preset(scarf != nullptr ? preset_name(scarf->preset) : "");
  all.push_back({scarf != nullptr ? preset : options.representation, preset, *parameters});
  return all;
}

nlohmann::json row(std::string_view implementation, const Variant& variant, bench::Scene scene,
                   SensorSize sensor, const Result<bench::PushTime>& time) {
  nlohmann::json out = {{"benchmark", "push"},
                        {"implementation", implementation},
                        {"representation", info_of(variant.parameters).name},
                        {"scene", bench::scene_name(scene)},
                        {"width", sensor.width},
                        {"height", sensor.height}};
  if (!variant.preset.empty()) out["preset"] = variant.preset;
  if (!time) {
    out["remark"] = time.error().message;
    return out;
  }
  out["ns_per_event"] = time->ns_per_event;
  out["query_us"] = time->query_us;
  out["events"] = time->events;
  return out;
}

// The stage that takes most of the device's time, and with --stages all of them.
std::string limiting_stage(const GpuRepresentation& representation, bool print_all) {
  StageTime most;
  uint64_t sum = 0;
  for (const StageTime& time : representation.stage_times()) {
    sum += time.nanoseconds;
    if (time.nanoseconds > most.nanoseconds) most = time;
  }
  for (const StageTime& time : representation.stage_times()) {
    if (!print_all) break;
    std::printf("    %-14s %8lu x %10.1f us %5.1f %%\n", time.stage.c_str(),
                static_cast<unsigned long>(time.dispatches),
                static_cast<double>(time.nanoseconds) / 1000 / static_cast<double>(time.dispatches),
                100.0 * static_cast<double>(time.nanoseconds) / static_cast<double>(sum));
  }
  if (sum == 0) return "no timestamps";
  return text(most.stage, " ", most.nanoseconds * 100 / sum, "%");
}

// The reference's memory is free again before the device is measured.
Result<bench::PushTime> time_reference(const Parameters& parameters, SensorSize sensor,
                                       std::span<const Event> stream, int repeats) {
  auto reference = make_reference_representation(parameters, sensor);
  if (!reference) return reference.error();
  return bench::time_push(**reference, stream, repeats);
}

struct DeviceTime {
  Result<bench::PushTime> time;
  std::string limited_by;
  std::vector<bench::StageFigure> stages;  // of SCARF, if they were asked for
};
DeviceTime time_device(std::shared_ptr<GpuContext> context, const Parameters& parameters, SensorSize sensor,
                       std::span<const Event> stream, int repeats, bool stages) {
  auto gpu = make_gpu_representation(context, parameters, sensor);
  if (!gpu) return {gpu.error(), "", {}};
  auto time = bench::time_push(**gpu, stream, repeats);
  if (!time) return {time, "", {}};
  auto* const scarf = dynamic_cast<GpuScarf*>(gpu->get());
  DeviceTime device{time, limiting_stage(**gpu, stages && scarf == nullptr), {}};
  if (!stages || scarf == nullptr) return device;
  auto figures = stage_figures(*context, *scarf, std::get<ScarfParameters>(parameters),
                               stream.first(std::min<size_t>(stream.size(), time->events)));
  if (!figures) return {figures.error(), "", {}};
  device.stages = *std::move(figures);
  return device;
}

std::string number(const Result<bench::PushTime>& time, double bench::PushTime::*figure, int decimals) {
  if (!time) return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, (*time).*figure);
  return buffer;
}

void print_row(const Variant& variant, bench::Scene scene, SensorSize sensor,
               const Result<bench::PushTime>& reference, const DeviceTime& device) {
  using bench::PushTime;
  char ratio[32] = "-";
  if (reference && device.time) {
    std::snprintf(ratio, sizeof ratio, "%.2f", reference->ns_per_event / device.time->ns_per_event);
  }
  std::printf("%-10s %-11s %-13s %9s %9s %7s %9s %9s  %s\n", text(sensor.width, 'x', sensor.height).c_str(),
              variant.name.c_str(), std::string(bench::scene_name(scene)).c_str(),
              number(reference, &PushTime::ns_per_event, 1).c_str(),
              number(device.time, &PushTime::ns_per_event, 1).c_str(), ratio,
              number(reference, &PushTime::query_us, 0).c_str(),
              number(device.time, &PushTime::query_us, 0).c_str(), device.limited_by.c_str());
  if (!reference) std::printf("    reference: %s\n", reference.error().message.c_str());
  if (!device.time) std::printf("    device: %s\n", device.time.error().message.c_str());
  std::fflush(stdout);
}

}  // namespace

Result<int> bench_scenes(const BenchOptions& options) {
  const size_t events = options.quick ? 400'000 : 4'000'000;
  const int repeats = options.quick ? 3 : 5;
  const auto lines = variants(options);
  if (!lines) return lines.error();
  auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  const DeviceInfo& device = (*context)->device();
  std::cout << "device " << device.name << ", driver " << device.driver << ", commit " << SCARF_COMMIT << "\n"
            << events << " events, one u8 image per " << bench::kEventsPerImage << ", median of " << repeats
            << "\n"
            << "ns per event, images included; us per query\n";
  std::optional<bench::Ceilings> ceilings;
  if (options.stages) {
    const auto measured = bench::measure_ceilings(**context);
    if (!measured) return measured.error();
    ceilings = *measured;
    print_ceilings(*ceilings);
  }
  std::printf("%-10s %-11s %-13s %9s %9s %7s %9s %9s  %s\n", "sensor",
              options.representation.empty() ? "preset" : "picture", "scene", "reference", "device", "ratio",
              "ref query", "dev query", "limited by");
  nlohmann::json results = nlohmann::json::array();
  for (const SensorSize sensor : kSensors) {
    for (const Variant& variant : *lines) {
      for (const bench::Scene scene : bench::kScenes) {
        const std::vector<Event> stream = bench::make_scene(scene, sensor, events);
        const auto reference = time_reference(variant.parameters, sensor, stream, repeats);
        const DeviceTime gpu =
            time_device(*context, variant.parameters, sensor, stream, repeats, options.stages);
        print_row(variant, scene, sensor, reference, gpu);
        results.push_back(row("reference", variant, scene, sensor, reference));
        results.push_back(row("gpu", variant, scene, sensor, gpu.time));
        if (gpu.stages.empty()) continue;
        print_stages(gpu.stages, *ceilings);
        results.back()["stages"] = stages_as_json(gpu.stages, *ceilings);
      }
    }
  }
  nlohmann::json report = {{"results", results}};
  if (ceilings) report["ceilings"] = as_json(*ceilings);
  if (auto r = write_report(options, &device, std::move(report)); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
