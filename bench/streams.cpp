#include "bench/streams.h"

#include <ctime>
#include <functional>
#include <span>

#include "bench/push.h"
#include "scarf/device/group.h"

namespace scarf::bench {
namespace {

// Of all threads of this process.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Streams that are fed round by round: batch i of a round goes to stream i.
struct Contender {
  std::vector<std::unique_ptr<GpuScarf>> streams;
  std::unique_ptr<GpuGroup> group;  // null: each stream flushes itself
  std::vector<double> seconds, cpu;

  Result<void> flush() {
    if (group != nullptr) return group->flush();
    for (const auto& stream : streams) {
      if (auto r = stream->flush(); !r) return r;
    }
    return {};
  }
  Result<void> wait_for_images() {
    if (group != nullptr) {
      const auto images = group->u8_images().wait();
      return images ? Result<void>() : images.error();
    }
    for (const auto& stream : streams) {
      if (const auto image = stream->u8_image().wait(); !image) return image.error();
    }
    return {};
  }
  Result<void> run(std::span<const Event> events, size_t round_events, bool images) {
    const size_t batch = round_events / streams.size();
    for (size_t i = 0; i < events.size(); i += batch) {
      const size_t stream = i / batch % streams.size();
      if (const auto pushed = streams[stream]->push(events.subspan(i, batch)); !pushed) return pushed.error();
      if (stream + 1 < streams.size()) continue;
      if (auto r = images ? wait_for_images() : flush(); !r) return r;
    }
    for (const auto& stream : streams) {
      if (auto r = stream->finish(); !r) return r;
    }
    return {};
  }
  Result<void> time(std::span<const Event> events, size_t round_events, bool images) {
    const auto start = Clock::now();
    const double cpu_start = cpu_seconds();
    if (auto r = run(events, round_events, images); !r) return r;
    seconds.push_back(seconds_since(start));
    cpu.push_back(cpu_seconds() - cpu_start);
    return {};
  }
  StreamTime result(size_t events) const {
    const double ns = 1e9 / static_cast<double>(events);
    return {median(seconds) * ns, median(cpu) * ns};
  }
};

Result<Contender> make_contender(const std::shared_ptr<GpuContext>& context, const Geometry& geometry,
                                 size_t streams, const GpuOptions& options) {
  Contender made;
  for (size_t i = 0; i < streams; ++i) {
    auto scarf = make_gpu_scarf(context, geometry, kDefaultAccumulation, options);
    if (!scarf) return scarf.error();
    made.streams.push_back(std::move(*scarf));
  }
  return made;
}

}  // namespace

Result<StreamTimes> time_streams(std::shared_ptr<GpuContext> context, const Geometry& geometry, Scene scene,
                                 size_t streams, size_t rounds, int repeats, bool images) {
  // Room for some batches while the device is busy: a full stream would submit itself.
  const GpuOptions small = {.submission_events = 4 * kStreamBatch};
  auto one = make_contender(context, geometry, 1, {});
  if (!one) return one.error();
  auto together = make_contender(context, geometry, streams, small);
  if (!together) return together.error();
  auto alone = make_contender(context, geometry, streams, small);
  if (!alone) return alone.error();
  together->group = make_gpu_group(context);
  for (const auto& stream : together->streams) {
    if (auto r = together->group->add(*stream); !r) return r.error();
  }
  const size_t round_events = streams * kStreamBatch;
  const std::vector<Event> events = make_scene(scene, geometry.sensor(), rounds * round_events);
  Contender* const contenders[] = {&*one, &*together, &*alone};
  for (Contender* contender : contenders) {
    if (auto r = contender->run(events, round_events, images); !r) return r.error();
  }
  for (int i = 0; i < repeats; ++i) {
    for (Contender* contender : contenders) {
      if (auto r = contender->time(events, round_events, images); !r) return r.error();
    }
  }
  return StreamTimes{one->result(events.size()),     together->result(events.size()),
                     alone->result(events.size()),   one->streams.front()->stage_times(),
                     together->group->stage_times(), events.size()};
}

}  // namespace scarf::bench
