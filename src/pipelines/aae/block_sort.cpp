#include "pipelines/aae/block_sort.h"

#include <algorithm>
#include <cmath>

#include "compiled_shaders/shaders.h"

namespace scarf {
namespace {

constexpr uint32_t kMostDigits = 8192;  // of a single pass
constexpr uint32_t kLeastChunk = 256;   // events
constexpr uint32_t kGpuChunks = 4;      // words of the table per event on devices with many lanes

uint32_t square_root(uint32_t n) {
  auto root = static_cast<uint32_t>(std::sqrt(n));
  while (uint64_t{root} * root < n) ++root;
  return root;
}

}  // namespace

void BlockSort::build(PipelineBuilder& b, const BlockGrid& grid, uint64_t most_events) {
  grid_ = grid;
  passes_ = grid.blocks() <= kMostDigits ? 1 : 2;
  digits_ = passes_ == 1 ? grid.blocks() : square_root(grid.blocks());
  // As many events in a chunk as there are digits: then the table costs no more than the events.
  chunk_events_ = std::max(kLeastChunk, b.device().limits().cpu ? digits_ : digits_ / kGpuChunks);
  prefix_.build(b, uint64_t{chunks_of(most_events)} * digits_);
  b.kernel(count_, "aae_sort_count", shaders::aae_sort_count, 3, sizeof(layout::BlockSortPush));
  b.kernel(write_, "aae_sort_write", shaders::aae_sort_write, 4, sizeof(layout::BlockSortPush));
}

uint32_t BlockSort::chunks_of(uint64_t events) const {
  return static_cast<uint32_t>((events + chunk_events_ - 1) / chunk_events_);
}

void BlockSort::bind(PipelineBuilder& b, Memory& target, const EventLog& log,
                     const EventLogMemory& memory) const {
  const uint64_t words = uint64_t{chunks_of(memory.capacity)} * digits_;
  b.buffer(target.table, "the table of the sort by block", words * sizeof(uint32_t));
  prefix_.bind(b, target.prefix, target.table);
  for (uint32_t pass = 0; pass < passes_; ++pass) {
    const vulkan::Buffer& from = pass == 0 ? memory.events : memory.scratch;
    const vulkan::Buffer& to = pass == 0 ? memory.scratch : memory.events;
    b.bind(target.passes[pass].count, count_, {&from, &log.length(), &target.table});
    b.bind(target.passes[pass].write, write_, {&from, &log.length(), &target.table, &to});
  }
}

void BlockSort::record(vulkan::Commands& commands, const Memory& memory, uint32_t events) const {
  layout::BlockSortPush push{};
  push.events = events;
  push.chunk_events = chunk_events_;
  push.chunks = chunks_of(events);
  push.divisor = 1;
  push.digits = digits_;
  push.block_width = static_cast<uint32_t>(grid_.block.width);
  push.block_height = static_cast<uint32_t>(grid_.block.height);
  push.block_columns = grid_.columns;
  const uint32_t words = push.chunks * digits_;
  for (uint32_t pass = 0; pass < passes_; ++pass, push.divisor *= digits_) {
    commands.fill(memory.table, uint64_t{words} * sizeof(uint32_t), 0);
    commands.barrier();
    commands.dispatch(memory.passes[pass].count, push.chunks, layout::kLinearGroup, push);
    commands.barrier();
    prefix_.record(commands, memory.prefix, words);
    commands.dispatch(memory.passes[pass].write, push.chunks, layout::kLinearGroup, push);
    commands.barrier();
  }
  commands.mark("sort");
}

}  // namespace scarf
