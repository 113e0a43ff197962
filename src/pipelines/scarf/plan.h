// How a SCARF stream is laid out and cut into work on a device: a pure function of geometry, limits and
// options.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ceil_div.h"
#include "scarf/core/patch_grid.h"
#include "scarf/core/result.h"
#include "scarf/device/tuning.h"
#include "vulkan/device.h"

namespace scarf {

/// One invocation per patch in workgroups of 64, at most 65,535 workgroups on the smallest device, and a scan
/// of 256 runs of patches within the loop budget of Quirks.
inline constexpr int64_t kMaxPatches = 4'000'000;

/// Events of one dispatch of the append stage: their laps fit into a head, whatever the capacity.
inline constexpr uint32_t kMostAppendEvents = 60'000;

/// A batch as chunks: contiguous runs of events, each walked by one team.
struct Chunking {
  uint32_t chunk_events = 0;
  uint32_t chunks = 0;
  uint32_t stripes = 1;  ///< no more than chunks, so that none is empty
  bool prune =
      false;  ///< so many hits do not survive that it pays to find out which events have none that do
};

/// How the append stage divides the patches: see shaders/scarf/scarf_append.comp.
struct AppendPlan {
  uint32_t lanes = 1;  ///< of a subgroup, which a workgroup is
  // As those of Plan, of the rows of one part.
  uint32_t team_x = 1;
  uint32_t team_y = 1;
  uint32_t lane_columns = 1;
  uint32_t lane_rows = 1;
  uint32_t teams = 1;  ///< that take events together
  uint32_t parts_shift = 0;
  uint32_t bands = 1;
  uint32_t band_rows = 0;
  uint32_t dispatch_events = 0;  ///< most events of one dispatch

  uint32_t parts() const { return 1U << parts_shift; }
  uint32_t workgroups() const { return parts() * bands; }
  uint32_t invocations() const { return workgroups() * lanes; }
};

struct Plan {
  uint32_t patches = 0;
  uint32_t capacity = 0;
  uint32_t most_columns = 1;  ///< most patches per axis that hold one pixel
  uint32_t most_rows = 1;
  // A team has team_x * team_y lanes, both powers of two; a lane owns up to lane_columns * lane_rows patches
  // of one event. See shaders/common/team.glsl.
  uint32_t team_x = 1;
  uint32_t team_y = 1;
  uint32_t lane_columns = 1;
  uint32_t lane_rows = 1;
  uint32_t teams_per_workgroup = 1;

  uint32_t submission_events = 0;  ///< most events of one submission
  uint32_t max_chunk_events = 0;   ///< most events of one chunk
  uint32_t max_chunks = 0;         ///< most chunks of one submission

  uint32_t class_columns = 1;  ///< classes of columns and of rows, class 0 included; see PixelClasses
  uint32_t class_rows = 1;
  uint32_t stripes = 1;  ///< see shaders/common/team.glsl; likewise the next two
  uint32_t bands = 1;
  uint32_t band_rows = 0;

  bool paints = false;           ///< 8-bit pictures come from the paint stage, which keeps them
  uint32_t cell_row_words = 0;   ///< of the positions that it needs; see kNotShown in shaders/common/layout.h
  uint32_t position_groups = 0;  ///< per patch

  AppendPlan append;
  bool appends = false;         ///< where prune does not pay
  bool always_appends = false;  ///< from the options

  uint32_t forced_chunk_events = 0;  ///< from the options; 0: free
  uint32_t target_chunks = 0;        ///< chunks that keep the device busy
  uint32_t least_chunk_events = 1;   ///< shorter ones do not pay, where there are enough chunks for all cores

  uint32_t team_lanes() const { return team_x * team_y; }
  uint32_t workgroup_size() const { return team_lanes() * teams_per_workgroup; }
  /// Words of the (chunk, patch) table.
  uint64_t table_words() const { return uint64_t{patches} * max_chunks; }
  /// Words of the counts per class of one chunk.
  uint32_t class_words() const { return class_columns * class_rows; }
  /// Teams of the place stage, for some stripes of chunks.
  uint64_t teams(uint32_t chunks, uint32_t in_stripes) const {
    return uint64_t{ceil_div(chunks, in_stripes)} * in_stripes * bands;
  }
  /// Most invocations of the place or append stage, those of unfinished workgroups included.
  uint64_t most_invocations() const {
    const uint64_t place = (teams(max_chunks, stripes) + teams_per_workgroup) * team_lanes();
    return std::max<uint64_t>(place, append.invocations());
  }
  /// Whether most hits of a submission are overwritten within it.
  bool prunes(uint32_t events) const;
  /// Whether a submission is appended, not cut into chunks.
  bool appended(uint32_t events) const { return always_appends || (appends && !prunes(events)); }
  /// Cuts a submission of `events` (at most submission_events).
  Chunking cut(uint32_t events) const;
  /// Chunks that pay, where the options leave it free; never fewer for more events.
  uint32_t worthwhile_chunks(uint32_t events) const;
};

/// Trips, loop entries included, that a place invocation takes per block of as many events as its
/// team has lanes.
uint32_t trips_per_block(const Plan& plan);
/// Of an append invocation likewise.
uint32_t trips_per_block(const AppendPlan& plan);

/// `levels`: 8-bit brightness of 0, 1, ... events. Errors: illegal_parameter for options out of range;
/// out_of_memory, by name, for a grid beyond the device.
Result<Plan> make_plan(const Geometry& geometry, std::span<const uint8_t> levels,
                       const vulkan::Limits& limits, const GpuOptions& options);

/// For each column 0 .. width-1 and one column outside, then each row likewise: the patches that hold it, as
/// first | last << 16; 1 | 0 << 16 where there are none.
std::vector<uint32_t> patch_ranges(const Geometry& geometry);

}  // namespace scarf
