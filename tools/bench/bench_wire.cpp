// scarf bench --wire: events on their way to a device.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/scenes.h"
#include "bench/wire.h"
#include "scarf/io/recordings.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

nlohmann::json measure(const std::string& stream, SensorSize sensor, std::span<const Event> events,
                       int repeats) {
  const bench::WireCost cost = bench::time_wire(events, sensor, repeats);
  std::printf("%-28s %5dx%-5d %10zu %8.3f %8.2f %8.2f %8.1f\n", stream.c_str(), sensor.width, sensor.height,
              events.size(), cost.bytes_per_event, cost.pack_ns, cost.copy_ns, sizeof(Event) / cost.pack_ns);
  std::fflush(stdout);
  return {{"benchmark", "wire"},
          {"stream", stream},
          {"width", sensor.width},
          {"height", sensor.height},
          {"events", events.size()},
          {"bytes_per_event", cost.bytes_per_event},
          {"pack_ns_per_event", cost.pack_ns},
          {"copy_ns_per_event", cost.copy_ns}};
}

Result<std::vector<Event>> events_of(EventSource& source) {
  std::vector<Event> events;
  for (size_t filled = 0;;) {
    events.resize(filled + (size_t{1} << 18));
    const auto n = source.read(std::span(events).subspan(filled));
    if (!n) return n.error();
    filled += *n;
    if (*n == 0) {
      events.resize(filled);
      return events;
    }
  }
}

}  // namespace

Result<int> bench_wire(const BenchOptions& options) {
  const size_t events = options.quick ? 400'000 : 4'000'000;
  const int repeats = options.quick ? 3 : 5;
  std::printf(
      "bytes per event on the bus; ns per event of one core to pack, and to copy 16 bytes; GB/s packed\n");
  std::printf("%-28s %-11s %10s %8s %8s %8s %8s\n", "stream", "     sensor", "events", "bytes", "pack",
              "copy", "GB/s");
  nlohmann::json results = nlohmann::json::array();
  for (const SensorSize sensor : {SensorSize{240, 180}, SensorSize{1280, 720}}) {
    for (const bench::Scene scene : bench::kScenes) {
      results.push_back(measure(std::string(bench::scene_name(scene)), sensor,
                                bench::make_scene(scene, sensor, events), repeats));
    }
  }
  for (const std::string& path : options.recordings) {
    const auto source = open_events(path, {.sensor = options.sensor});
    if (!source) return source.error();
    const auto sensor = require_sensor(**source, path);
    if (!sensor) return sensor.error();
    const auto recorded = events_of(**source);
    if (!recorded) return recorded.error();
    if (recorded->empty()) continue;
    results.push_back(measure(path.substr(path.find_last_of('/') + 1), *sensor, *recorded, repeats));
  }
  if (auto r = write_report(options, nullptr, {{"results", results}}); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
