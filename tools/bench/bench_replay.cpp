// scarf bench --replay: 1000 pictures per second of recorded time, by a replay and by a stream.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/endless.h"
#include "bench/push.h"
#include "bench/replay.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

// A camera in motion, and its events per second of recorded time.
struct Recording {
  SensorSize sensor;
  double rate;
};
constexpr Recording kRecordings[] = {{{240, 180}, 5e6}, {{1280, 720}, 20e6}};
constexpr double kFramesPerSecond = 1000;

struct Row {
  SensorSize sensor;
  size_t events = 0;
  uint64_t frames = 0;
  double stream_seconds = 0;
  double replay_seconds = 0;
  double device_seconds = 0;  // of the replay; 0: no timestamps
  std::vector<StageTime> stages;

  double per_second(double seconds) const { return seconds > 0 ? static_cast<double>(frames) / seconds : 0; }
  double ns_per_event(double seconds) const { return seconds * 1e9 / static_cast<double>(events); }
};

Result<Row> measure(std::shared_ptr<GpuContext> context, const Recording& recording, size_t count,
                    int repeats) {
  const auto events = bench::shaken_scene(recording.sensor, count, recording.rate);
  if (!events) return events.error();
  const auto geometry = make_geometry(Preset::paper, recording.sensor);
  if (!geometry) return geometry.error();
  const auto per_frame = static_cast<size_t>(recording.rate / kFramesPerSecond);
  Row row{.sensor = recording.sensor, .events = events->size(), .stages = {}};
  std::vector<double> stream_times;
  std::vector<double> replay_times;
  // One after the other, and one round to warm up.
  for (int i = 0; i <= repeats; ++i) {
    const auto stream = make_gpu_scarf(context, *geometry);
    if (!stream) return stream.error();
    const auto start = bench::Clock::now();
    if (auto r = bench::push_and_render(**stream, *events, per_frame, per_frame); !r) return r.error();
    const double seconds = bench::seconds_since(start);
    auto replay = bench::time_replay(context, *geometry, *events, per_frame);
    if (!replay) return replay.error();
    if (i == 0) continue;
    stream_times.push_back(seconds);
    replay_times.push_back(replay->seconds);
    row.frames = replay->frames;
    row.stages = std::move(replay->stages);
  }
  row.stream_seconds = bench::median(stream_times);
  row.replay_seconds = bench::median(replay_times);
  for (const StageTime& stage : row.stages)
    row.device_seconds += static_cast<double>(stage.nanoseconds) * 1e-9;
  return row;
}

void print(const Row& row, bool stages) {
  std::printf("%5dx%-5d %9zu %7lu %12.0f %12.0f %7.2f %12.0f %10.1f %10.1f\n", row.sensor.width,
              row.sensor.height, row.events, static_cast<unsigned long>(row.frames),
              row.per_second(row.stream_seconds), row.per_second(row.replay_seconds),
              row.stream_seconds / row.replay_seconds, row.per_second(row.device_seconds),
              row.ns_per_event(row.stream_seconds), row.ns_per_event(row.replay_seconds));
  for (const StageTime& stage : row.stages) {
    if (!stages) break;
    std::printf("    %-10s %10.1f us per frame\n", stage.stage.c_str(),
                static_cast<double>(stage.nanoseconds) / 1000 / static_cast<double>(row.frames));
  }
  std::fflush(stdout);
}

nlohmann::json json_of(const Row& row) {
  nlohmann::json stages;
  for (const StageTime& stage : row.stages) stages[stage.stage] = stage.nanoseconds;
  return {{"benchmark", "replay"},
          {"width", row.sensor.width},
          {"height", row.sensor.height},
          {"preset", "paper"},
          {"events", row.events},
          {"frames", row.frames},
          {"stream_frames_per_second", row.per_second(row.stream_seconds)},
          {"replay_frames_per_second", row.per_second(row.replay_seconds)},
          {"kernel_frames_per_second", row.per_second(row.device_seconds)},
          {"stream_ns_per_event", row.ns_per_event(row.stream_seconds)},
          {"replay_ns_per_event", row.ns_per_event(row.replay_seconds)},
          {"stage_nanoseconds", stages}};
}

}  // namespace

Result<int> bench_replay(const BenchOptions& options) {
  const size_t events = options.quick ? 1'000'000 : 4'000'000;
  const int repeats = options.quick ? 1 : 3;
  const auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  const DeviceInfo& device = (*context)->device();
  std::cout << "device " << device.name << ", driver " << device.driver << ", commit " << SCARF_COMMIT << "\n"
            << "scarf, preset paper, a u8 picture per millisecond of recorded time, median of " << repeats
            << "\n";
  std::printf("%-11s %9s %7s %12s %12s %7s %12s %10s %10s\n", "sensor", "events", "frames", "stream fps",
              "replay fps", "ratio", "kernel fps", "stream ns", "replay ns");
  nlohmann::json results = nlohmann::json::array();
  for (const Recording& recording : kRecordings) {
    const auto row = measure(*context, recording, events, repeats);
    if (!row) return row.error();
    print(*row, options.stages);
    results.push_back(json_of(*row));
  }
  if (auto r = write_report(options, &device, {{"results", results}}); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
