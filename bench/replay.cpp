#include "bench/replay.h"

#include <algorithm>

#include "bench/push.h"

namespace scarf::bench {

Result<ReplayTime> time_replay(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                               std::span<const Event> events, size_t events_per_frame) {
  ReplayTime time;
  Image<uint8_t> image;
  const auto take = [&](const ReplayFrame<uint8_t>& frame) -> Result<void> {
    image = Image<uint8_t>(frame.sensor.width, frame.sensor.height);
    std::copy(frame.pixels.begin(), frame.pixels.end(), image.pixels.begin());
    ++time.frames;
    return {};
  };
  const auto replay = make_gpu_replay<uint8_t>(std::move(context), geometry, take);
  if (!replay) return replay.error();
  const auto start = Clock::now();
  for (size_t i = 0; i < events.size(); i += events_per_frame) {
    const auto pushed = (*replay)->push(events.subspan(i, std::min(events_per_frame, events.size() - i)));
    if (!pushed) return pushed.error();
    if (auto r = (*replay)->frame(); !r) return r.error();
  }
  if (auto r = (*replay)->finish(); !r) return r.error();
  time.seconds = seconds_since(start);
  time.stages = (*replay)->stage_times();
  return time;
}

}  // namespace scarf::bench
