// The events of a submission by tile, in their order: for stages that replay the events of a part of the
// sensor.
#pragma once

#include <cstdint>

#include "kernels/pipeline_builder.h"
#include "kernels/scan.h"
#include "scarf/core/event.h"
#include "scarf/core/patch_grid.h"
#include "shaders/kernels/tile_lists_layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// How tile lists are laid out and made: a pure function of what is wanted and of the device.
struct TileListsPlan {
  SensorSize sensor;
  uint32_t tile = 0;         ///< pixels per side of a tile
  uint32_t halo = 0;         ///< an event within so many pixels of a tile, per axis, is in its list
  uint32_t most_events = 0;  ///< of a submission

  uint32_t tiles_x = 0;
  uint32_t tiles_y = 0;
  uint32_t most_lists = 0;    ///< lists that hold the same event, at most
  uint32_t chunk_events = 0;  ///< events are counted and ranked in contiguous runs

  uint32_t tiles() const { return tiles_x * tiles_y; }
  uint32_t chunks(uint32_t events) const { return (events + chunk_events - 1) / chunk_events; }
  /// Words of the table of tiles and chunks; its last word is the sum.
  uint64_t table_words() const { return uint64_t{tiles()} * chunks(most_events) + 1; }
  uint64_t list_words() const { return uint64_t{most_lists} * most_events; }
};

TileListsPlan make_tile_lists_plan(SensorSize sensor, uint32_t tile, uint32_t halo, uint32_t most_events,
                                   const vulkan::Limits& limits);

/// Trips, loop entries included, that an invocation of tile_lists_place takes.
uint64_t place_trips(const TileListsPlan& plan);

/// After record(), the list of tile i (row-major) is lists()[begin .. end-1]: indices of events within the
/// submission, ascending, where begin is begins()[i * chunks] and end is begins()[(i + 1) * chunks], with the
/// chunks that record() returns. Events outside the sensor are in no list.
class TileLists {
 public:
  /// Kernels bound to one buffer of events.
  struct Bound {
    vulkan::BoundKernel count, place;
  };

  void build(PipelineBuilder& builder, const TileListsPlan& plan);
  void bind(PipelineBuilder& builder, Bound& bound, const vulkan::Buffer& events) const;

  /// Makes the lists of events first .. first+count-1. What was written before must be visible; the lists are
  /// visible to what follows.
  layout::TileListsPush record(vulkan::Commands& commands, const Bound& bound, uint32_t first,
                               uint32_t count) const;

  const TileListsPlan& plan() const { return plan_; }
  const vulkan::Buffer& begins() const { return begins_; }
  const vulkan::Buffer& lists() const { return lists_; }

 private:
  TileListsPlan plan_;
  vulkan::Buffer begins_, lists_;
  vulkan::Kernel count_, place_;
  PrefixSum sum_;
  PrefixSum::Source sum_begins_;
};

}  // namespace scarf
