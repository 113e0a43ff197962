// scarf bench --streams: many small streams on one device.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/streams.h"
#include "core/text.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

constexpr SensorSize kSensors[] = {{240, 180}, {640, 480}, {1280, 720}};
constexpr Preset kPresets[] = {Preset::paper, Preset::light};
constexpr bench::Scene kScenes[] = {bench::Scene::uniform, bench::Scene::edges};

// How much of one stream's throughput remains.
double share(double one, double many) {
  return one / many;
}

nlohmann::json as_json(const bench::StreamTime& time) {
  return {{"ns_per_event", time.ns_per_event}, {"cpu_ns_per_event", time.cpu_ns_per_event}};
}

void print_stages(const char* title, const std::vector<StageTime>& stages) {
  uint64_t sum = 0;
  for (const StageTime& time : stages) sum += time.nanoseconds;
  std::printf("    %-9s", title);
  for (const StageTime& time : stages) {
    std::printf(" %s %.0f%%", time.stage.c_str(),
                100.0 * static_cast<double>(time.nanoseconds) / static_cast<double>(sum));
  }
  std::printf("\n");
}

}  // namespace

Result<int> bench_streams(const BenchOptions& options) {
  auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  const DeviceInfo& device = (*context)->device();
  const size_t streams = *options.streams;
  const size_t rounds = options.quick ? 2 : device.type == "cpu" ? 6 : 40;
  const int repeats = options.quick ? 3 : 5;
  std::printf("device %s, driver %s, commit %s\n", device.name.c_str(), device.driver.c_str(), SCARF_COMMIT);
  std::printf(
      "one stream of %zu events per batch, and %zu streams of %zu in one submission or one each; median of "
      "%d\nns per event, of processor time ns per event; share of the throughput of the one stream\n",
      streams * bench::kStreamBatch, streams, bench::kStreamBatch, repeats);
  std::printf("%-10s %-6s %-8s %-7s %14s %14s %14s %9s %9s\n", "sensor", "preset", "scene", "images", "one",
              "together", "alone", "share", "of cpu");
  nlohmann::json results = nlohmann::json::array();
  for (const SensorSize sensor : kSensors) {
    for (const Preset preset : kPresets) {
      const auto geometry = make_geometry(preset, sensor);
      if (!geometry) return geometry.error();
      for (const bench::Scene scene : kScenes) {
        for (const bool images : {false, true}) {
          if (options.quick && (images || scene != kScenes[0])) continue;
          const auto times =
              bench::time_streams(*context, *geometry, scene, streams, rounds, repeats, images);
          if (!times) return times.error();
          const double wall = share(times->one.ns_per_event, times->together.ns_per_event);
          const double cpu = share(times->one.cpu_ns_per_event, times->together.cpu_ns_per_event);
          const std::string preset_word(preset_name(preset));
          const std::string scene_word(bench::scene_name(scene));
          std::printf("%4dx%-5d %-6s %-8s %-7s %6.0f %7.0f %6.0f %7.0f %6.0f %7.0f %8.0f%% %8.0f%%\n",
                      sensor.width, sensor.height, preset_word.c_str(), scene_word.c_str(),
                      images ? "with" : "without", times->one.ns_per_event, times->one.cpu_ns_per_event,
                      times->together.ns_per_event, times->together.cpu_ns_per_event,
                      times->alone.ns_per_event, times->alone.cpu_ns_per_event, 100 * wall, 100 * cpu);
          if (options.stages) {
            print_stages("one", times->one_stages);
            print_stages("together", times->together_stages);
          }
          std::fflush(stdout);
          results.push_back({{"benchmark", "streams"},
                             {"width", sensor.width},
                             {"height", sensor.height},
                             {"preset", preset_word},
                             {"scene", scene_word},
                             {"images", images},
                             {"streams", streams},
                             {"batch", bench::kStreamBatch},
                             {"events", times->events},
                             {"one", as_json(times->one)},
                             {"together", as_json(times->together)},
                             {"alone", as_json(times->alone)},
                             {"share", wall},
                             {"cpu_share", cpu}});
        }
      }
    }
  }
  if (auto r = write_report(options, &device, {{"results", results}}); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
