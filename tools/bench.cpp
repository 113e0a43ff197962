// scarf bench: the device beside the reference, in one run.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/push.h"
#include "bench/scenes.h"
#include "core/text.h"
#include "scarf/gpu.h"
#include "scarf/reference.h"
#include "tools/commands.h"
#include "tools/files.h"

namespace scarf::tools {
namespace {

struct BenchOptions {
  bool quick = false;
  bool stages = false;
  std::string json;
  DeviceOptions device;
};

constexpr SensorSize kSensors[] = {{240, 180}, {346, 260}, {640, 480}, {1280, 720}};
constexpr Preset kPresets[] = {Preset::paper, Preset::light};

nlohmann::json row(std::string_view implementation, Preset preset, bench::Scene scene, SensorSize sensor,
                   const bench::PushTime& time) {
  return {{"benchmark", "push"},           {"implementation", implementation},  {"representation", "scarf"},
          {"preset", preset_name(preset)}, {"scene", bench::scene_name(scene)}, {"width", sensor.width},
          {"height", sensor.height},       {"ns_per_event", time.ns_per_event}, {"query_us", time.query_us}};
}

// The stage that takes most of the device's time, and with --stages all of them.
std::string limiting_stage(const GpuScarf& scarf, bool print_all) {
  StageTime most;
  uint64_t sum = 0;
  for (const StageTime& time : scarf.stage_times()) {
    sum += time.nanoseconds;
    if (time.nanoseconds > most.nanoseconds) most = time;
  }
  for (const StageTime& time : scarf.stage_times()) {
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
Result<bench::PushTime> time_reference(const Geometry& geometry, std::span<const Event> stream, int repeats) {
  auto reference = make_reference_scarf(geometry);
  if (!reference) return reference.error();
  return bench::time_push(**reference, stream, repeats);
}

Result<int> bench(const BenchOptions& options) {
#ifndef NDEBUG
  return Error{ErrorCode::device,
               "this is a debug build, whose times mean nothing; build with the release preset"};
#endif
  const size_t events = options.quick ? 400'000 : 4'000'000;
  const int repeats = options.quick ? 3 : 5;
  auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  const DeviceInfo& device = (*context)->device();
  std::cout << "device " << device.name << ", driver " << device.driver << ", commit " << SCARF_COMMIT << "\n"
            << events << " events, one u8 image per " << bench::kEventsPerImage << ", median of " << repeats
            << "\n"
            << "ns per event, images included; us per query\n";
  std::printf("%-10s %-6s %-13s %9s %9s %7s %9s %9s  %s\n", "sensor", "preset", "scene", "reference",
              "device", "ratio", "ref query", "dev query", "limited by");
  nlohmann::json results = nlohmann::json::array();
  for (SensorSize sensor : kSensors) {
    for (Preset preset : kPresets) {
      const auto geometry = make_geometry(preset, sensor);
      if (!geometry) return geometry.error();
      for (bench::Scene scene : bench::kScenes) {
        const std::vector<Event> stream = bench::make_scene(scene, sensor, events);
        const auto reference_time = time_reference(*geometry, stream, repeats);
        if (!reference_time) return reference_time.error();
        auto gpu = make_gpu_scarf(*context, *geometry);
        if (!gpu) return gpu.error();
        const auto gpu_time = bench::time_push(**gpu, stream, repeats);
        if (!gpu_time) return gpu_time.error();
        std::printf("%-10s %-6s %-13s %9.1f %9.1f %7.2f %9.0f %9.0f  %s\n",
                    text(sensor.width, 'x', sensor.height).c_str(), std::string(preset_name(preset)).c_str(),
                    std::string(bench::scene_name(scene)).c_str(), reference_time->ns_per_event,
                    gpu_time->ns_per_event, reference_time->ns_per_event / gpu_time->ns_per_event,
                    reference_time->query_us, gpu_time->query_us,
                    limiting_stage(**gpu, options.stages).c_str());
        std::fflush(stdout);
        results.push_back(row("reference", preset, scene, sensor, *reference_time));
        results.push_back(row("gpu", preset, scene, sensor, *gpu_time));
      }
    }
  }
  if (!options.json.empty()) {
    const nlohmann::json report = {
        {"device", device.name}, {"driver", device.driver}, {"commit", SCARF_COMMIT}, {"results", results}};
    if (auto r = write_file(options.json, report.dump(1) + "\n"); !r) return r.error();
  }
  return 0;
}

}  // namespace

void add_bench(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("bench", "Measure the device beside the reference");
  auto options = std::make_shared<BenchOptions>();
  app->add_flag("--quick", options->quick, "A tenth of the events, median of 3");
  app->add_flag("--stages", options->stages, "Device time of each stage");
  app->add_option("--json", options->json, "Write the results to this file as well");
  app->add_option("--device", options->device.device, "Index, part of the name, UUID or type of the device");
  app->add_flag("--require-gpu", options->device.require_gpu, "A CPU device is an error");
  app->callback([&command, options] { command.run = [options] { return bench(*options); }; });
}

}  // namespace scarf::tools
