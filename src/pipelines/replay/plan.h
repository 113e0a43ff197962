// How a replay is cut into groups and chunks, and how large its buffers are: pure functions of geometry,
// limits and options.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarf/core/patch_grid.h"
#include "scarf/device/replay.h"
#include "shaders/replay/replay_layout.h"
#include "vulkan/device.h"

namespace scarf {

/// What the pixels of a replay's pictures are.
enum class ReplayPixels { u8, f32, counts };

struct ReplayPlan {
  uint32_t patches = 0;
  uint32_t capacity = 0;
  uint32_t pixels = 0;  ///< of a picture

  // A team has team_x * team_y lanes, both powers of two; a lane owns up to lane_columns * lane_rows patches
  // of one event. See shaders/replay/replay_rank.comp.
  uint32_t team_x = 1;
  uint32_t team_y = 1;
  uint32_t lane_columns = 1;
  uint32_t lane_rows = 1;
  uint32_t teams_per_workgroup = 1;

  uint32_t group_events = 0;      ///< most events of one group
  uint32_t group_frames = 0;      ///< most frames of one group
  uint32_t max_chunk_events = 0;  ///< most events of one chunk
  uint32_t max_chunks = 0;        ///< most chunks of one group
  uint32_t target_chunks = 0;     ///< chunks that keep the device busy

  uint32_t count_bits = 8;       ///< of a pixel's count in the changes: enough for capacity
  uint32_t bytes_per_pixel = 1;  ///< of a picture

  uint32_t team_lanes() const { return team_x * team_y; }
  uint32_t workgroup_size() const { return team_lanes() * teams_per_workgroup; }
  /// Words of the table per chunk.
  uint32_t stride() const { return patches + team_lanes(); }
  uint32_t kept_words() const { return (capacity + 31) / 32; }
  /// Invocations of the frames stage: four pixels each.
  uint32_t picture_invocations() const;
  uint32_t change_words() const { return picture_invocations() * count_bits / 8; }
  /// Of one picture in the memory for the host; at its end up to three pixels that mean nothing.
  uint64_t picture_bytes() const { return uint64_t{picture_invocations()} * 4 * bytes_per_pixel; }

  uint64_t table_bytes() const { return uint64_t{stride()} * max_chunks * 4; }
  uint64_t changes_bytes() const { return (uint64_t{group_frames} + 1) * change_words() * 4; }
  uint64_t pictures_bytes() const { return group_frames * picture_bytes(); }
};

/// Trips, loop entries included, that an invocation of the rank stage takes per block of as many events as
/// its team has lanes.
uint32_t rank_trips(const ReplayPlan& plan);

/// Errors: illegal_parameter for options out of range; out_of_memory, by name, for pictures and grids beyond
/// the device.
Result<ReplayPlan> make_replay_plan(const Geometry& geometry, ReplayPixels pixels,
                                    const vulkan::Limits& limits, const ReplayOptions& options);

/// Cuts a group of `events` events whose frames come after the given numbers of events (ascending). Behind
/// the chunks is a last entry that begins where they end.
std::vector<layout::ReplayChunk> cut_group(const ReplayPlan& plan, uint32_t events,
                                           std::span<const uint32_t> frames);

}  // namespace scarf
