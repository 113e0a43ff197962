#include "bench/stage_work.h"

#include <algorithm>

#include "shaders/common/layout.h"

namespace scarf::bench {
namespace {

constexpr uint64_t kWord = sizeof(uint32_t);
constexpr uint64_t kSlot = sizeof(uint64_t);
constexpr uint64_t kHead = sizeof(uint32_t) + sizeof(uint64_t);  // and laps
constexpr uint64_t kReadAndWritten = 2;

StageWork work(std::string_view stage, uint64_t bytes, uint64_t atomics = 0) {
  return {stage, static_cast<double>(bytes), static_cast<double>(atomics)};
}

}  // namespace

Hits count_hits(const Geometry& geometry, std::span<const Event> events) {
  Hits hits{.events = static_cast<uint32_t>(events.size())};
  std::vector<uint64_t> per_patch(geometry.patches());
  const std::vector<uint32_t> ranges = patch_ranges(geometry);
  const uint32_t* const rows = ranges.data() + geometry.x.size + 1;
  for (const Event& e : events) {
    if (!geometry.sensor().contains(e)) continue;
    const uint32_t columns = ranges[e.x];
    for (uint32_t j = rows[e.y] & 0xFFFF; j <= rows[e.y] >> 16; ++j) {
      for (uint32_t i = columns & 0xFFFF; i <= columns >> 16; ++i) ++per_patch[j * geometry.x.grid + i];
    }
  }
  for (const uint64_t count : per_patch) {
    hits.hits += count;
    hits.stored += std::min<uint64_t>(count, geometry.capacity);
    hits.patches += count != 0 ? 1 : 0;
  }
  return hits;
}

std::vector<StageWork> push_work(const Plan& plan, const Hits& hits) {
  const uint64_t stored_bytes = kSlot + (plan.paints ? 1 : 0);
  if (plan.appended(hits.events)) {
    return {work("append", plan.append.workgroups() * uint64_t{hits.events} * sizeof(Event) +
                               hits.patches * kWord * kReadAndWritten + hits.hits * stored_bytes)};
  }
  const Chunking chunking = plan.cut(hits.events);
  const uint64_t events = uint64_t{hits.events} * sizeof(Event);
  const uint64_t counts = uint64_t{chunking.chunks} * plan.class_words();
  const uint64_t entries = uint64_t{chunking.chunks} * plan.patches;
  std::vector<StageWork> all = {
      work("clear", counts * kWord),
      work("count", events + std::min<uint64_t>(hits.events, counts) * kWord * kReadAndWritten, hits.events),
      work("sum", 2 * counts * kWord * kReadAndWritten),
      work("scan", counts * kWord + 3 * entries * kWord + plan.patches * kHead * kReadAndWritten +
                       hits.patches * kWord),
  };
  if (chunking.prune) all.push_back(work("prune", 2 * entries * kWord));
  const uint64_t pruned = chunking.prune ? std::min<uint64_t>(hits.events, entries) * kWord : 0;
  all.push_back(work("place", plan.bands * (events + pruned) +
                                  std::min(hits.hits, entries) * kWord * kReadAndWritten +
                                  hits.stored * stored_bytes));
  return all;
}

std::vector<StageWork> image_work(const Geometry& geometry, const Plan& plan, const Hits& hits) {
  const uint64_t pixels = uint64_t{static_cast<uint32_t>(geometry.x.size)} * geometry.y.size;
  const StageWork copy = work("copy", pixels * kReadAndWritten);
  if (plan.paints) {
    const uint64_t positions = uint64_t{plan.position_groups} * layout::kSlotsPerGroup;
    const uint64_t cell = uint64_t{static_cast<uint32_t>(geometry.x.cell)} * geometry.y.cell;
    return {work("paint", 2 * plan.patches * kWord + hits.patches * (kWord + positions + cell)), copy};
  }
  const uint64_t slots = uint64_t{plan.patches} * plan.capacity;
  return {work("render", pixels * kWord + slots * kSlot + plan.patches * kHead +
                             std::min(slots, pixels) * kWord * kReadAndWritten),
          work("tone", pixels * (kWord + 1)), copy};
}

}  // namespace scarf::bench
