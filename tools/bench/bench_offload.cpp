// scarf bench --offload: a device as the place where very many events go.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/offload.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

constexpr SensorSize kSensors[] = {{240, 180}, {1280, 720}};

nlohmann::json as_json(SensorSize sensor, const bench::Offload& o) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageTime& time : o.stages) {
    stages.push_back(
        {{"stage", time.stage},
         {"dispatches", time.dispatches},
         {"ns_per_event", static_cast<double>(time.nanoseconds) / static_cast<double>(o.events)}});
  }
  return {{"benchmark", "offload"},
          {"width", sensor.width},
          {"height", sensor.height},
          {"events", o.events},
          {"kernel_ns_per_event", o.kernel_ns_per_event},
          {"stream_events_per_s", o.stream_events_per_s},
          {"frames_per_s", o.frames_per_s},
          {"copy_fraction", o.copy_fraction},
          {"latency_median_us", o.latency_median_us},
          {"latency_p99_us", o.latency_p99_us},
          {"stages", stages}};
}

}  // namespace

void print_ceilings(const bench::Ceilings& c) {
  std::printf(
      "measured: copy %.1f GB/s, %.2f G atomics/s, upload %.1f GB/s, readback %.1f GB/s, submission %.1f "
      "us\n",
      c.copy_bytes_per_s * 1e-9, c.atomics_per_s * 1e-9, c.upload_bytes_per_s * 1e-9,
      c.readback_bytes_per_s * 1e-9, c.submission_us);
}

nlohmann::json as_json(const bench::Ceilings& c) {
  return {{"copy_bytes_per_s", c.copy_bytes_per_s},
          {"atomics_per_s", c.atomics_per_s},
          {"upload_bytes_per_s", c.upload_bytes_per_s},
          {"readback_bytes_per_s", c.readback_bytes_per_s},
          {"submission_us", c.submission_us}};
}

Result<int> bench_offload(const BenchOptions& options) {
  auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  const DeviceInfo& device = (*context)->device();
  std::printf("device %s, driver %s, commit %s\n", device.name.c_str(), device.driver.c_str(), SCARF_COMMIT);
  const auto ceilings = bench::measure_ceilings(**context);
  if (!ceilings) return ceilings.error();
  print_ceilings(*ceilings);

  // A device with a processor's speed takes seconds for what a GPU does in a moment.
  const bool slow = options.quick || device.type == "cpu";
  const size_t events = slow ? 4'000'000 : 100'000'000;
  const size_t latencies = slow ? 200 : 2'000;
  std::printf(
      "SCARF paper, uniform scene, batches of %zu with a u8 image after each; latency of %zu events\n",
      bench::kOffloadBatch, bench::kLatencyBatch);
  std::printf("%-10s %14s %14s %10s %10s %14s %12s\n", "sensor", "kernel ns/ev", "stream Mev/s", "frames/s",
              "of copies", "latency p50 us", "p99 us");
  nlohmann::json results = nlohmann::json::array();
  for (const SensorSize sensor : kSensors) {
    const auto offload = bench::measure_offload(*context, *ceilings, sensor, events, latencies);
    if (!offload) return offload.error();
    std::printf("%4dx%-5d %14.3f %14.2f %10.1f %9.1f%% %14.0f %12.0f\n", sensor.width, sensor.height,
                offload->kernel_ns_per_event, offload->stream_events_per_s * 1e-6, offload->frames_per_s,
                offload->copy_fraction * 100, offload->latency_median_us, offload->latency_p99_us);
    std::fflush(stdout);
    results.push_back(as_json(sensor, *offload));
  }
  const nlohmann::json report = {{"ceilings", as_json(*ceilings)}, {"results", results}};
  if (auto r = write_report(options, &device, report); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
