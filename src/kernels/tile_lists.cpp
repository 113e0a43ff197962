#include "kernels/tile_lists.h"

#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"

namespace scarf {
namespace {

// An event is compared with those before it in its chunk, and the table has an entry per tile and chunk.
constexpr uint32_t kLeastChunkEvents = 64;
constexpr uint32_t kMostChunkEvents = 1024;
constexpr uint64_t kTableWords = uint64_t{1} << 22;

// Tiles per axis that have a pixel in common with a window of the halo's reach.
constexpr uint32_t most_tiles(const TileListsPlan& plan, uint32_t tiles) {
  return std::min(tiles, (2 * plan.halo + plan.tile - 1) / plan.tile + 1);
}

}  // namespace

uint64_t place_trips(const TileListsPlan& plan) {
  const uint64_t columns = most_tiles(plan, plan.tiles_x);
  const uint64_t rows = most_tiles(plan, plan.tiles_y);
  return 1 + rows * (2 + columns * (2 + uint64_t{plan.chunk_events}));
}

TileListsPlan make_tile_lists_plan(SensorSize sensor, uint32_t tile, uint32_t halo, uint32_t most_events,
                                   const vulkan::Limits& limits) {
  TileListsPlan plan;
  plan.sensor = sensor;
  plan.tile = tile;
  plan.halo = halo;
  plan.most_events = most_events;
  plan.tiles_x = ceil_div(static_cast<uint32_t>(sensor.width), tile);
  plan.tiles_y = ceil_div(static_cast<uint32_t>(sensor.height), tile);
  plan.most_lists = most_tiles(plan, plan.tiles_x) * most_tiles(plan, plan.tiles_y);
  plan.chunk_events = kLeastChunkEvents;
  while (plan.table_words() > kTableWords && plan.chunk_events < kMostChunkEvents) plan.chunk_events *= 2;
  while (place_trips(plan) > limits.loop_trips && plan.chunk_events > 1) plan.chunk_events /= 2;
  return plan;
}

void TileLists::build(PipelineBuilder& builder, const TileListsPlan& plan) {
  plan_ = plan;
  builder.buffer(begins_, "the table of tiles and chunks", plan.table_words() * sizeof(uint32_t));
  builder.buffer(lists_, "the lists of events per tile", plan.list_words() * sizeof(uint32_t));
  builder.kernel(count_, "tile_lists_count", shaders::tile_lists_count, vulkan::Bindings::vectors_and(1),
                 sizeof(layout::TileListsPush));
  builder.kernel(place_, "tile_lists_place", shaders::tile_lists_place, vulkan::Bindings::vectors_and(2),
                 sizeof(layout::TileListsPush));
  sum_.build(builder, plan.table_words());
  sum_.bind(builder, sum_begins_, begins_);
}

void TileLists::bind(PipelineBuilder& builder, Bound& bound, const vulkan::Buffer& events) const {
  builder.bind(bound.count, count_, {&events, &begins_});
  builder.bind(bound.place, place_, {&events, &begins_, &lists_});
}

layout::TileListsPush TileLists::record(vulkan::Commands& commands, const Bound& bound, uint32_t first,
                                        uint32_t count) const {
  layout::TileListsPush push{};
  push.first_event = first;
  push.events = count;
  push.chunk_events = plan_.chunk_events;
  push.chunks = plan_.chunks(count);
  push.width = static_cast<uint32_t>(plan_.sensor.width);
  push.height = static_cast<uint32_t>(plan_.sensor.height);
  push.tile = plan_.tile;
  push.halo = plan_.halo;
  push.tiles_x = plan_.tiles_x;
  push.tiles_y = plan_.tiles_y;
  const uint32_t words = plan_.tiles() * push.chunks + 1;
  commands.fill(begins_, uint64_t{words} * sizeof(uint32_t), 0);
  commands.barrier();
  commands.dispatch(bound.count, count, layout::kLinearGroup, push);
  commands.barrier();
  sum_.record(commands, sum_begins_, words);
  commands.dispatch(bound.place, count, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("tile_lists");
  return push;
}

}  // namespace scarf
