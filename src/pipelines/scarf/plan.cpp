#include "pipelines/scarf/plan.h"

#include <algorithm>
#include <bit>

#include "core/text.h"
#include "kernels/submission.h"
#include "pipelines/scarf/pixel_classes.h"
#include "shaders/common/layout.h"

namespace scarf {
namespace {

// Most patches of one axis that hold the same pixel.
uint32_t most_holders(const GridAxis& axis) {
  int32_t most = 1;
  for (int32_t v = 0; v < axis.size; ++v) {
    const PatchRange range = axis.patches_holding(v);
    most = std::max(most, range.last - range.first + 1);
  }
  return static_cast<uint32_t>(most);
}

// Counts and cursors of all chunks are written and summed for every submission, so more of them is not
// better.
constexpr uint64_t kTableBytesCpu = uint64_t{32} << 20;
constexpr uint64_t kTableBytesGpu = uint64_t{256} << 20;
// Chunks for each core of a CPU device: as many as keep the counts of all chunks small, within a range.
constexpr uint32_t kLeastChunksPerCore = 2;
constexpr uint32_t kMostChunksPerCore = 16;
constexpr uint32_t kTargetCountsCpu = 1u << 16;
// Chunks that keep every multiprocessor of a GPU busy.
constexpr uint32_t kTargetChunksGpu = 2048;

// Shorter chunks cost more in counts and cursors than they gain. On CPU devices these are summed by few
// cores: a chunk has some events for each count, or is long enough for any counts.
constexpr uint32_t kLeastEventsPerCountCpu = 2;
constexpr uint32_t kLongChunkCpu = 5'000;
constexpr uint32_t kLeastChunkEventsGpu = 64;

constexpr uint64_t kPruneHitsPerSlot = 3;

// Rings that are written in no order: of each one line of 64 bytes of slots and one of positions is in use. A
// cache of a CPU's core holds about so many.
constexpr uint32_t kRingsInCache = 4096;

// Hits of an event in a part of the patches from which on it pays to walk the events once for each band.
constexpr uint32_t kHitsWorthBands = 4;

// Levels that do not change beyond those that travel as push constants.
bool few(std::span<const uint8_t> levels) {
  constexpr size_t kLast = layout::kPushedLevels - 1;
  if (levels.size() <= kLast) return false;
  return std::all_of(levels.begin() + kLast, levels.end(),
                     [&](uint8_t level) { return level == levels[kLast]; });
}

constexpr uint32_t kMaxTeamLanes = 32;  // see team_ballot() in shaders/common/team.glsl
// Teams that take events together compare each with each.
constexpr uint32_t kMostTeams = 4;

// A loop costs its trips and one for its entry. Where a lane owns many patches of an event, it loops over
// rows and columns of them.
uint32_t trips_per_event(uint32_t lane_columns, uint32_t lane_rows) {
  if (lane_columns == 1 && lane_rows <= 2) return 0;
  return lane_rows * (1 + lane_columns + 1) + 1;
}

AppendPlan make_append_plan(const Plan& plan, const Geometry& geometry, const vulkan::Limits& limits,
                            const GpuOptions& options) {
  AppendPlan a;
  a.lanes = limits.subgroup_size;
  // Each core has rows of its own of the patches of most events.
  a.parts_shift = std::bit_width(std::min(limits.cores, plan.most_rows)) - 1;
  const uint32_t lanes = std::min(a.lanes, kMaxTeamLanes);
  const uint32_t event_rows = ceil_div(plan.most_rows, a.parts());
  a.team_x = std::min(std::bit_ceil(plan.most_columns), lanes);
  a.team_y = std::min(std::bit_ceil(event_rows), lanes / a.team_x);
  a.lane_columns = ceil_div(plan.most_columns, a.team_x);
  a.lane_rows = ceil_div(event_rows, a.team_y);
  // Lanes of several teams must see each other's heads.
  if (limits.lanes_in_step) a.teams = std::min({lanes / (a.team_x * a.team_y), kMostTeams, plan.capacity});
  const uint32_t rows = ceil_div(static_cast<uint32_t>(geometry.y.grid), a.parts());
  const bool many_hits = plan.most_columns * event_rows >= kHitsWorthBands;
  const uint32_t wanted_bands = many_hits ? ceil_div(plan.patches / a.parts(), kRingsInCache) : 1;
  a.band_rows = ceil_div(rows, std::min(rows, options.bands != 0 ? options.bands : wanted_bands));
  a.bands = ceil_div(rows, a.band_rows);
  const uint64_t blocks = (limits.loop_trips - 8) / trips_per_block(a);
  a.dispatch_events = static_cast<uint32_t>(std::min<uint64_t>(blocks * lanes, kMostAppendEvents));
  return a;
}

}  // namespace

uint32_t trips_per_block(const Plan& plan) {
  // Blocks, the search for one that is walked, events.
  return 1 + 2 + plan.team_lanes() * (1 + trips_per_event(plan.lane_columns, plan.lane_rows)) + 1;
}

uint32_t trips_per_block(const AppendPlan& plan) {
  // Blocks, steps, and for each the other teams twice.
  const uint32_t steps = ceil_div(std::min(plan.lanes, kMaxTeamLanes), plan.teams);
  return 1 + steps * (1 + 2 * plan.teams + trips_per_event(plan.lane_columns, plan.lane_rows)) + 1;
}

// As many for each core, and no lane of a core without work: bands of one chunk are work for several.
uint32_t Plan::worthwhile_chunks(uint32_t events) const {
  const uint32_t teams = stripes * teams_per_workgroup;
  const uint32_t evenly = events / least_chunk_events / teams * teams;
  return std::min(target_chunks, std::max(evenly, ceil_div(teams, bands)));
}

// Where most patches get several times their capacity.
bool Plan::prunes(uint32_t events) const {
  const uint64_t hits = uint64_t{events} * most_columns * most_rows;
  return hits >= kPruneHitsPerSlot * patches * capacity;
}

Chunking Plan::cut(uint32_t events) const {
  if (events == 0) return {};
  uint32_t chunk =
      forced_chunk_events != 0 ? forced_chunk_events : ceil_div(events, worthwhile_chunks(events));
  chunk = std::clamp(chunk, ceil_div(events, max_chunks), max_chunk_events);
  const uint32_t chunks = ceil_div(events, chunk);
  return {chunk, chunks, std::min(stripes, chunks), prunes(events)};
}

Result<Plan> make_plan(const Geometry& geometry, std::span<const uint8_t> levels,
                       const vulkan::Limits& limits, const GpuOptions& options) {
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

  plan.class_columns = pixel_classes(geometry.x).count;
  plan.class_rows = pixel_classes(geometry.y).count;
  plan.stripes = limits.cores;
  const uint32_t rows = static_cast<uint32_t>(geometry.y.grid);
  const uint32_t wanted_bands = limits.cpu ? ceil_div(plan.patches, kRingsInCache) : 1;
  plan.band_rows = ceil_div(rows, std::min(rows, options.bands != 0 ? options.bands : wanted_bands));
  plan.bands = ceil_div(rows, plan.band_rows);
  plan.cell_row_words = ceil_div(static_cast<uint32_t>(geometry.x.cell), 4);
  plan.position_groups = ceil_div(plan.capacity, layout::kSlotsPerGroup);
  plan.paints =
      plan.capacity <= 255 && plan.cell_row_words * geometry.y.cell <= layout::kPaintWords && few(levels);

  // 8: the entry of the loop over blocks, and loops of the compiler itself.
  const uint32_t blocks = (limits.loop_trips - 8) / trips_per_block(plan);
  plan.max_chunk_events = static_cast<uint32_t>(
      std::min<uint64_t>(layout::kMaxChunkEvents, uint64_t{blocks} * plan.team_lanes()));
  const uint64_t table_bytes = std::min(limits.cpu ? kTableBytesCpu : kTableBytesGpu, limits.storage_range);
  const uint64_t words = std::max(plan.patches, plan.class_words());
  const uint64_t chunks_that_fit = table_bytes / (words * sizeof(uint32_t));
  const uint32_t scan_budget = (limits.loop_trips - 8) / 2 - 1;  // the scan walks the chunks twice
  plan.max_chunks =
      static_cast<uint32_t>(std::clamp<uint64_t>(chunks_that_fit, 1, std::min(scan_budget, 1u << 16)));
  const uint32_t chunks_per_core = std::clamp(kTargetCountsCpu / plan.class_words() / limits.cores,
                                              kLeastChunksPerCore, kMostChunksPerCore);
  plan.target_chunks =
      std::min(plan.max_chunks, limits.cpu ? chunks_per_core * limits.cores : kTargetChunksGpu);

  plan.least_chunk_events = limits.cpu ? std::min(kLeastEventsPerCountCpu * plan.class_words(), kLongChunkCpu)
                                       : kLeastChunkEventsGpu;

  plan.forced_chunk_events = std::min(options.chunk_events, plan.max_chunk_events);
  const uint32_t longest = plan.forced_chunk_events != 0 ? plan.forced_chunk_events : plan.max_chunk_events;
  const uint32_t wanted = scarf::submission_events(options, limits);
  plan.submission_events =
      static_cast<uint32_t>(std::min<uint64_t>(wanted, uint64_t{plan.max_chunks} * longest));
  plan.append = make_append_plan(plan, geometry, limits, options);
  plan.always_appends = options.placing == GpuOptions::Placing::appended;
  // All cores have work, and the same.
  plan.appends = options.placing == GpuOptions::Placing::automatic && options.chunk_events == 0 &&
                 limits.cpu && limits.cores == plan.append.parts();
  // No more room than the longest submission can use.
  plan.max_chunks = std::min(plan.max_chunks, std::max(plan.worthwhile_chunks(plan.submission_events),
                                                       ceil_div(plan.submission_events, longest)));
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
