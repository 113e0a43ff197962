#include "bench/offload.h"

#include <algorithm>

#include "bench/push.h"
#include "bench/scenes.h"

namespace scarf::bench {
namespace {

// Whether the stage is none of the kernels of a push: it copies, or answers a query.
bool beside_pushes(const StageTime& time) {
  static constexpr std::string_view kOthers[] = {"reset", "upload", "render", "paint", "tone", "copy"};
  return std::find(std::begin(kOthers), std::end(kOthers), time.stage) != std::end(kOthers);
}

}  // namespace

Result<Offload> measure_offload(std::shared_ptr<GpuContext> context, const Ceilings& ceilings,
                                SensorSize sensor, size_t events, size_t latencies) {
  const auto geometry = make_geometry(Preset::paper, sensor);
  if (!geometry) return geometry.error();
  const auto scarf = make_gpu_scarf(context, *geometry, kDefaultAccumulation,
                                    {.submission_events = static_cast<uint32_t>(kOffloadBatch)});
  if (!scarf) return scarf.error();
  const std::vector<Event> stream = make_scene(Scene::uniform, sensor, kOffloadBatch);
  if (auto r = push_and_render(**scarf, stream, kOffloadBatch, kOffloadBatch); !r) return r.error();
  if (auto r = (*scarf)->finish(); !r) return r.error();

  Offload offload;
  const auto before = (*scarf)->stage_times();
  const size_t batches = std::max<size_t>(events / kOffloadBatch, 2);
  std::vector<Event> many;
  for (size_t i = 0; i < batches; ++i) many.insert(many.end(), stream.begin(), stream.end());
  const auto start = Clock::now();
  if (auto r = push_and_render(**scarf, many, kOffloadBatch, kOffloadBatch); !r) return r.error();
  if (auto r = (*scarf)->finish(); !r) return r.error();
  const double seconds = seconds_since(start);

  offload.events = many.size();
  offload.stream_events_per_s = static_cast<double>(many.size()) / seconds;
  offload.frames_per_s = static_cast<double>(batches) / seconds;
  const double picture_bytes = static_cast<double>(sensor.width) * sensor.height;
  const double crossed = static_cast<double>(many.size()) * sizeof(Event) / ceilings.upload_bytes_per_s +
                         static_cast<double>(batches) * picture_bytes / ceilings.readback_bytes_per_s;
  offload.copy_fraction = crossed / seconds;
  uint64_t kernel_ns = 0;
  for (StageTime time : (*scarf)->stage_times()) {
    for (const StageTime& old : before) {
      if (old.stage != time.stage) continue;
      time.nanoseconds -= old.nanoseconds;
      time.dispatches -= old.dispatches;
    }
    if (!beside_pushes(time)) kernel_ns += time.nanoseconds;
    offload.stages.push_back(time);
  }
  offload.kernel_ns_per_event = static_cast<double>(kernel_ns) / static_cast<double>(many.size());

  std::vector<double> times;
  for (size_t i = 0; i < latencies; ++i) {
    const auto batch =
        std::span(stream).subspan(i * kLatencyBatch % (stream.size() - kLatencyBatch), kLatencyBatch);
    const auto handed_over = Clock::now();
    if (const auto pushed = (*scarf)->push(batch); !pushed) return pushed.error();
    if (const auto image = (*scarf)->u8_image().wait(); !image) return image.error();
    times.push_back(seconds_since(handed_over) * 1e6);
  }
  std::sort(times.begin(), times.end());
  offload.latency_median_us = times[times.size() / 2];
  offload.latency_p99_us = times[times.size() * 99 / 100];
  return offload;
}

}  // namespace scarf::bench
