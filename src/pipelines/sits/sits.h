// SITS on a device: how its work is cut, for make_sits and its tests.
#pragma once

#include <cstdint>
#include <optional>

#include "pipelines/base/pipelines.h"
#include "scarf/core/image.h"

namespace scarf {

/// Two ways to the same values.
enum class SitsStrategy {
  walk,    ///< one team takes the events one by one
  sweeps,  ///< every tile replays its events, until what they say of each other settles; else walk
};

/// For tests: choices that are otherwise made for the device. None changes a result.
struct SitsChoices {
  std::optional<SitsStrategy> strategy;
  std::optional<uint32_t> sweeps;  ///< of a submission, at most; at least 1
  std::optional<uint32_t> tile;    ///< pixels, a power of two, 16 to 64
};

struct SitsPlan {
  SitsStrategy strategy = SitsStrategy::walk;
  // A team has team_x * team_y lanes, both powers of two, which are a whole subgroup. See sits_team.glsl.
  uint32_t team_x = 1;
  uint32_t team_y = 1;
  uint32_t tile = 0;               ///< pixels per side
  uint32_t sweeps = 0;             ///< of a submission, at most
  uint32_t submission_events = 0;  ///< most events of one submission
  uint32_t walk_events = 0;        ///< most events of one dispatch of the walk

  uint32_t team_lanes() const { return team_x * team_y; }
};

/// A pure function. `kernel` is odd.
SitsPlan make_sits_plan(int32_t kernel, const vulkan::Limits& limits, const GpuOptions& options,
                        const SitsChoices& choices = {});

/// Trips, loop entries included, that an invocation takes per block of as many events as its team has lanes,
/// where windows are clipped to `most_pixels` per axis.
uint64_t sits_trips_per_block(const SitsPlan& plan, uint32_t most_pixels);

/// Brightness of the values 0 .. k * k.
Levels sits_levels(const SitsParameters& parameters);

MadePipeline make_sits(vulkan::Device& device, const SitsParameters& parameters, SensorSize sensor,
                       const GpuOptions& options, const SitsChoices& choices);

}  // namespace scarf
