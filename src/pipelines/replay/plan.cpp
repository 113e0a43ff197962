#include "pipelines/replay/plan.h"

#include <algorithm>
#include <bit>

#include "core/ceil_div.h"
#include "core/text.h"
#include "pipelines/scarf/plan.h"

namespace scarf {
namespace {

constexpr uint32_t kMostGroupEvents = 1u << 24;  // ranks within a group are signed and have 32 bits
constexpr uint32_t kMostGroupFrames = 4096;
constexpr uint32_t kMostChunks = 1u << 16;  // see chunk_beyond() in shaders/replay/replay_changes.glsl
constexpr uint32_t kLeastChunks = 4;        // a frame or two, and cuts of what lies between them

// A group costs a walk over the rings and a few dispatches; more than that is paid back by is no better.
struct Budget {
  uint64_t picture_bytes;
  uint64_t table_bytes;
  uint32_t events;
  uint32_t target_chunks;  // that keep every core of a CPU device, or every multiprocessor of a GPU, busy
};
constexpr Budget kBudgetCpu = {32u << 20, 64u << 20, 1u << 20, 16};
constexpr Budget kBudgetGpu = {256u << 20, 256u << 20, 1u << 22, 2048};

constexpr uint32_t kMaxTeamLanes = 32;
constexpr uint32_t kOtherTrips = 8;  // the entry of an outer loop, and loops of the compiler itself

Error illegal(const char* name, uint32_t value, uint32_t most) {
  return {ErrorCode::illegal_parameter, text(name, " is ", value, ", legal is 0 to ", most)};
}

Result<void> check(const ReplayOptions& o) {
  if (o.group_frames > kMostGroupFrames) return illegal("group_frames", o.group_frames, kMostGroupFrames);
  if (o.group_events > kMostGroupEvents) return illegal("group_events", o.group_events, kMostGroupEvents);
  if (o.chunk_events > layout::kMaxChunkEvents)
    return illegal("chunk_events", o.chunk_events, layout::kMaxChunkEvents);
  return {};
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

void choose_team(ReplayPlan& plan, const Geometry& geometry, const vulkan::Limits& limits) {
  const uint32_t columns = most_holders(geometry.x);
  const uint32_t rows = most_holders(geometry.y);
  const uint32_t lanes = std::min(limits.subgroup_size, kMaxTeamLanes);
  plan.team_x = std::min(std::bit_ceil(columns), lanes);
  plan.team_y = std::min(std::bit_ceil(rows), lanes / plan.team_x);
  plan.lane_columns = ceil_div(columns, plan.team_x);
  plan.lane_rows = ceil_div(rows, plan.team_y);
  plan.teams_per_workgroup = limits.subgroup_size / plan.team_lanes();
}

Error too_large(const char* what, uint64_t bytes, uint64_t most) {
  return {ErrorCode::out_of_memory,
          text(what, " of a replay needs ", bytes, " bytes, but a buffer of this device holds at most ", most,
               "; use a smaller sensor or larger cells, or another device")};
}

}  // namespace

uint32_t ReplayPlan::picture_invocations() const {
  return ceil_div(pixels, layout::kReplayPixels);
}

uint32_t rank_trips(const ReplayPlan& plan) {
  // A loop costs its trips and one for its entry: blocks of events, events, rows and columns of patches.
  const uint32_t columns = plan.lane_columns + 1;
  const uint32_t rows = plan.lane_rows * (1 + columns) + 1;
  return 1 + plan.team_lanes() * (1 + rows) + 1;
}

Result<ReplayPlan> make_replay_plan(const Geometry& geometry, ReplayPixels pixels,
                                    const vulkan::Limits& limits, const ReplayOptions& options) {
  if (auto r = check(options); !r) return r.error();
  if (geometry.patches() > kMaxPatches) {
    return Error{ErrorCode::out_of_memory,
                 text("the grid has ", geometry.patches(), " patches, a replay at most ", kMaxPatches,
                      "; use larger cells or a smaller sensor")};
  }
  const Budget& budget = limits.cpu ? kBudgetCpu : kBudgetGpu;
  ReplayPlan plan;
  plan.patches = static_cast<uint32_t>(geometry.patches());
  plan.capacity = static_cast<uint32_t>(geometry.capacity);
  plan.pixels = static_cast<uint32_t>(geometry.x.size) * static_cast<uint32_t>(geometry.y.size);
  plan.count_bits = plan.capacity <= 0xFF ? 8 : 16;
  plan.bytes_per_pixel = pixels == ReplayPixels::u8 ? 1 : 4;
  choose_team(plan, geometry, limits);

  const uint32_t blocks = (limits.loop_trips - kOtherTrips) / rank_trips(plan);
  plan.max_chunk_events = static_cast<uint32_t>(
      std::min<uint64_t>(layout::kMaxChunkEvents, uint64_t{blocks} * plan.team_lanes()));
  if (options.chunk_events != 0)
    plan.max_chunk_events = std::min(plan.max_chunk_events, options.chunk_events);

  // Rows of the table: a chunk for each frame, as frames divide chunks, and as many again for long gaps
  // between them.
  const uint64_t range = limits.storage_range;
  const uint64_t row_bytes = uint64_t{plan.stride()} * 4;
  if (kLeastChunks * row_bytes > range) return too_large("the table", kLeastChunks * row_bytes, range);
  const uint64_t rows = std::clamp<uint64_t>(std::min(budget.table_bytes, range) / row_bytes, kLeastChunks,
                                             std::min(kMostChunks, limits.loop_trips - kOtherTrips));
  const uint64_t change_bytes = uint64_t{plan.change_words()} * 4;
  const uint64_t largest = std::max(plan.picture_bytes(), 2 * change_bytes);
  if (largest > range) return too_large("a picture", largest, range);
  const uint64_t fitting = std::min(range / plan.picture_bytes(), range / change_bytes - 1);
  const uint64_t wanted =
      options.group_frames != 0
          ? options.group_frames
          : std::clamp<uint64_t>(budget.picture_bytes / plan.picture_bytes(), 1, kMostGroupFrames);
  plan.group_frames = static_cast<uint32_t>(std::min({wanted, fitting, rows / 2}));

  const uint64_t cuts = rows - plan.group_frames - 1;
  const uint64_t events = options.group_events != 0 ? options.group_events : budget.events;
  plan.group_events = static_cast<uint32_t>(std::min(events, cuts * plan.max_chunk_events));
  plan.target_chunks = static_cast<uint32_t>(std::min<uint64_t>(budget.target_chunks, cuts));
  // No more rows than the largest group can use.
  plan.max_chunks = static_cast<uint32_t>(
      plan.group_frames + 1 +
      std::max<uint64_t>(plan.target_chunks, ceil_div(plan.group_events, plan.max_chunk_events)));
  return plan;
}

std::vector<layout::ReplayChunk> cut_group(const ReplayPlan& plan, uint32_t events,
                                           std::span<const uint32_t> frames) {
  // Intervals are cut into runs of this length, so there are at most events / length + frames + 1 chunks.
  const uint32_t length = std::min(ceil_div(std::max(events, 1u), plan.target_chunks), plan.max_chunk_events);
  std::vector<layout::ReplayChunk> chunks;
  uint32_t begin = 0;
  for (uint32_t interval = 0; interval <= frames.size(); ++interval) {
    const uint32_t end = interval < frames.size() ? frames[interval] : events;
    for (; begin < end; begin += std::min(length, end - begin)) chunks.push_back({begin, interval});
  }
  chunks.push_back({events, static_cast<uint32_t>(frames.size())});
  return chunks;
}

}  // namespace scarf
