#include "bench/stages.h"

#include <algorithm>
#include <map>

#include "bench/push.h"

namespace scarf::bench {
namespace {

using WorkByStage = std::map<std::string, StageWork, std::less<>>;

void add(WorkByStage& sums, std::span<const StageWork> some) {
  for (const StageWork& work : some) {
    StageWork& sum = sums[std::string(work.stage)];
    sum.bytes += work.bytes;
    sum.atomics += work.atomics;
  }
}

// The first of `count` parts of nearly equal size begins at 0, the last ends at `size`.
size_t part_begin(size_t size, size_t part, size_t count) {
  return size * part / count;
}

// Calls `use` with the hits of each of `count` parts of the events.
template <class Use>
void for_each_part(const Geometry& geometry, std::span<const Event> events, size_t count, Use use) {
  for (size_t part = 0; part < count; ++part) {
    const size_t begin = part_begin(events.size(), part, count);
    const size_t end = part_begin(events.size(), part + 1, count);
    use(count_hits(geometry, events.subspan(begin, end - begin)));
  }
}

std::vector<StageTime> times_since(const GpuScarf& scarf, std::span<const StageTime> before) {
  std::vector<StageTime> times = scarf.stage_times();
  for (StageTime& time : times) {
    for (const StageTime& old : before) {
      if (old.stage != time.stage) continue;
      time.nanoseconds -= old.nanoseconds;
      time.dispatches -= old.dispatches;
    }
  }
  std::erase_if(times, [](const StageTime& time) { return time.dispatches == 0; });
  return times;
}

uint64_t dispatches_of(std::span<const StageTime> times, std::string_view stage) {
  for (const StageTime& time : times) {
    if (time.stage == stage) return time.dispatches;
  }
  return 0;
}

}  // namespace

Result<std::vector<StageFigure>> measure_stages(GpuScarf& scarf, const Plan& plan,
                                                std::span<const Event> events) {
  // Times count once their work is done.
  if (auto r = scarf.finish(); !r) return r.error();
  const auto before = scarf.stage_times();
  if (auto r = push_and_render(scarf, events, kEventsPerImage, kEventsPerImage); !r) return r.error();
  if (auto r = scarf.finish(); !r) return r.error();
  const std::vector<StageTime> times = times_since(scarf, before);

  const Geometry& geometry = scarf.geometry();
  WorkByStage sums;
  // A batch may become two submissions, where staging memory ends.
  for_each_part(geometry, events, dispatches_of(times, "count") + dispatches_of(times, "append"),
                [&](const Hits& hits) { add(sums, push_work(plan, hits)); });
  for_each_part(geometry, events, dispatches_of(times, "copy"),
                [&](const Hits& hits) { add(sums, image_work(geometry, plan, hits)); });

  std::vector<StageFigure> figures;
  const auto count = static_cast<double>(events.size());
  for (const StageTime& time : times) {
    StageFigure figure;
    figure.stage = time.stage;
    figure.dispatches = time.dispatches;
    figure.ns_per_event = static_cast<double>(time.nanoseconds) / count;
    if (const auto found = sums.find(time.stage); found != sums.end()) {
      figure.bytes_per_event = found->second.bytes / count;
      figure.atomics_per_event = found->second.atomics / count;
    }
    figures.push_back(figure);
  }
  return figures;
}

}  // namespace scarf::bench
