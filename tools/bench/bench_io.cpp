// scarf bench --io: the readers, each beside the plain reading of its file and, where blocks are compressed,
// beside their unpacking alone.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/reading.h"
#include "bench/scenes.h"
#include "core/text.h"
#include "io/files/output_files.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

constexpr SensorSize kSensor = {1280, 720};

Result<void> write_recording(const std::string& path, const std::string& format,
                             std::span<const Event> events) {
  const auto sink = create_events(path, format, kSensor);
  if (!sink) return sink.error();
  if (auto r = (*sink)->write(events); !r) return r;
  return (*sink)->finish();
}

// Prints the line of a recording and appends it to the results.
Result<void> measure(const std::string& name, const std::string& path, const ReadOptions& options,
                     int repeats, nlohmann::json& results) {
  const auto time = bench::time_reading(path, options, repeats);
  if (!time) return time.error();
  const double bytes_per_event = static_cast<double>(time->bytes) / static_cast<double>(time->events);
  char unpacking[16] = "-";
  if (time->unpacking_ns_per_event) {
    std::snprintf(unpacking, sizeof unpacking, "%.2f", *time->unpacking_ns_per_event);
  }
  std::printf("%-13s %10lu %10.2f %10.2f %10.1f %10.2f %10s  %s\n", time->format.c_str(),
              static_cast<unsigned long>(time->events), bytes_per_event, time->ns_per_event,
              1e3 / time->ns_per_event, time->file_ns_per_event, unpacking, name.c_str());
  std::fflush(stdout);
  results.push_back({{"benchmark", "io"},
                     {"format", time->format},
                     {"recording", name},
                     {"events", time->events},
                     {"bytes_per_event", bytes_per_event},
                     {"ns_per_event", time->ns_per_event},
                     {"file_ns_per_event", time->file_ns_per_event}});
  if (time->unpacking_ns_per_event) {
    results.back()["unpacking_ns_per_event"] = *time->unpacking_ns_per_event;
  }
  return {};
}

}  // namespace

Result<int> bench_io(const BenchOptions& options) {
  const int repeats = options.quick ? 3 : 7;
  std::printf("commit %s; processor time of one core, median of %d, file in the page cache\n", SCARF_COMMIT,
              repeats);
  std::printf("%-13s %10s %10s %10s %10s %10s %10s  %s\n", "format", "events", "B/event", "ns/event", "Mev/s",
              "file ns", "unpack ns", "recording");
  nlohmann::json results = nlohmann::json::array();
  for (const std::string& path : options.recordings) {
    if (auto r = measure(path, path, {options.sensor}, repeats, results); !r) return r.error();
  }
  if (options.recordings.empty()) {
    const std::vector<Event> events =
        bench::make_scene(bench::Scene::edges, kSensor, options.quick ? 400'000 : 4'000'000);
    const auto scratch = ScratchFolder::create((fs::temp_directory_path() / "scarf_bench").string());
    if (!scratch) return scratch.error();
    for (const FormatInfo& format : formats()) {
      if (!format.written || !format.missing.empty()) continue;
      const std::string path = scratch->file(format.name);
      if (auto r = write_recording(path, format.name, events); !r) return r.error();
      ReadOptions read;
      if (!format.recognised) read = {kSensor, format.name};
      if (auto r = measure("edges", path, read, repeats, results); !r) return r.error();
      if (auto r = remove_file(path); !r) return r.error();
    }
  }
  if (auto r = write_report(options, nullptr, {{"results", results}}); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
