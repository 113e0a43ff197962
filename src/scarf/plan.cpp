#include "scarf/plan.h"

#include <algorithm>
#include <bit>

#include "core/text.h"
#include "gpu/submission.h"
#include "shaders/layout.h"

namespace scarf {
namespace {

uint32_t ceil_div(uint64_t a, uint64_t b) {
  return static_cast<uint32_t>((a + b - 1) / b);
}

// Most patches of one axis that hold the same pixel.
uint32_t most_holders(const GridAxis& axis) {
  int32_t most = 1;
  for (int32_t v = 0; v < axis.size; ++v) {
    const PatchRange range = axis.patches_holding(v);
    most = std::max(most, range.last - range.first + 1);
  }
  return static_cast<uint32_t>(most);
}

// The table is cleared, summed and walked for every submission, so more of it is not better.
constexpr uint64_t kTableBytesCpu = uint64_t{32} << 20;
constexpr uint64_t kTableBytesGpu = uint64_t{256} << 20;
// Chunks that keep every core of a CPU device, or every multiprocessor of a GPU, busy.
constexpr uint32_t kTargetChunksCpu = 16;
constexpr uint32_t kTargetChunksGpu = 2048;

constexpr uint64_t kPruneHitsPerSlot = 4;
// An atomic on a CPU device costs as much as two loads; the sums over corners cost some of each.
constexpr uint32_t kMostHitsCountedOneByOne = 6;

constexpr uint32_t kMaxTeamLanes = 32;  // see team_ballot() in shaders/team.glsl

}  // namespace

uint32_t trips_per_block(const Plan& plan) {
  // A loop costs its trips and one for its entry: blocks of events, events, rows and columns of patches.
  const uint32_t columns = plan.lane_columns + 1;
  const uint32_t rows = plan.lane_rows * (1 + columns) + 1;
  return 1 + plan.team_lanes() * (1 + rows) + 1;
}

Chunking Plan::cut(uint32_t events) const {
  if (events == 0) return {};
  uint32_t chunk = forced_chunk_events != 0 ? forced_chunk_events : ceil_div(events, target_chunks);
  chunk = std::clamp(chunk, ceil_div(events, max_chunks), max_chunk_events);
  // Where most patches get several times their capacity, most hits are overwritten within the batch.
  const uint64_t hits = uint64_t{events} * most_columns * most_rows;
  const bool prune = hits >= kPruneHitsPerSlot * patches * capacity;
  return {chunk, ceil_div(events, chunk), prune};
}

Result<Plan> make_plan(const Geometry& geometry, const vulkan::Limits& limits, const GpuOptions& options) {
  if (geometry.patches() > kMaxPatches) {
    return Error{ErrorCode::out_of_memory,
                 text("the grid has ", geometry.patches(), " patches, a device stream at most ", kMaxPatches,
                      "; use larger cells or a smaller sensor")};
  }
  if (auto r = check_options(options); !r) return r.error();
  Plan plan;
  plan.patches = static_cast<uint32_t>(geometry.patches());
  plan.capacity = static_cast<uint32_t>(geometry.capacity);
  plan.most_columns = most_holders(geometry.x);
  plan.most_rows = most_holders(geometry.y);
  const uint32_t lanes = std::min(limits.subgroup_size, kMaxTeamLanes);
  plan.team_x = std::min(std::bit_ceil(plan.most_columns), lanes);
  plan.team_y = std::min(std::bit_ceil(plan.most_rows), lanes / plan.team_x);
  plan.lane_columns = ceil_div(plan.most_columns, plan.team_x);
  plan.lane_rows = ceil_div(plan.most_rows, plan.team_y);
  plan.teams_per_workgroup = limits.subgroup_size / plan.team_lanes();

  plan.count_corners = plan.most_columns * plan.most_rows > kMostHitsCountedOneByOne;

  // 8: the entry of the loop over blocks, and loops of the compiler itself.
  const uint32_t blocks = (limits.loop_trips - 8) / trips_per_block(plan);
  plan.max_chunk_events = static_cast<uint32_t>(
      std::min<uint64_t>(layout::kMaxChunkEvents, uint64_t{blocks} * plan.team_lanes()));
  const uint64_t table_bytes = std::min(limits.cpu ? kTableBytesCpu : kTableBytesGpu, limits.storage_range);
  const uint64_t chunks_that_fit = table_bytes / (uint64_t{plan.patches} * sizeof(uint32_t));
  const uint32_t scan_budget = (limits.loop_trips - 8) / 2 - 1;  // the scan walks the chunks twice
  plan.max_chunks =
      static_cast<uint32_t>(std::clamp<uint64_t>(chunks_that_fit, 1, std::min(scan_budget, 1u << 16)));
  plan.target_chunks = std::min(plan.max_chunks, limits.cpu ? kTargetChunksCpu : kTargetChunksGpu);

  plan.forced_chunk_events = std::min(options.chunk_events, plan.max_chunk_events);
  const uint32_t longest = plan.forced_chunk_events != 0 ? plan.forced_chunk_events : plan.max_chunk_events;
  const uint32_t wanted = scarf::submission_events(options, limits);
  plan.submission_events =
      static_cast<uint32_t>(std::min<uint64_t>(wanted, uint64_t{plan.max_chunks} * longest));
  // No more room than the longest submission can use.
  plan.max_chunks =
      std::min(plan.max_chunks, std::max(plan.target_chunks, ceil_div(plan.submission_events, longest)));
  return plan;
}

std::vector<uint32_t> patch_ranges(const Geometry& geometry) {
  constexpr uint32_t kNone = 1;
  std::vector<uint32_t> ranges;
  ranges.reserve(geometry.x.size + geometry.y.size + 2);
  for (const GridAxis* axis : {&geometry.x, &geometry.y}) {
    for (int32_t v = 0; v < axis->size; ++v) {
      const PatchRange range = axis->patches_holding(v);
      const bool none = range.last < range.first;
      ranges.push_back(none ? kNone
                            : static_cast<uint32_t>(range.first) | static_cast<uint32_t>(range.last) << 16);
    }
    ranges.push_back(kNone);
  }
  return ranges;
}

}  // namespace scarf
