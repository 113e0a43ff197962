// A stable sort of an event log by blocks of the sensor.
#pragma once

#include <cstdint>

#include "core/block_grid.h"
#include "kernels/event_log.h"
#include "kernels/pipeline_builder.h"
#include "kernels/scan.h"
#include "shaders/aae/aae_layout.h"

namespace scarf {

/// Counting sort by one digit of the block's number, or by two if there are many blocks: a table has one
/// entry for each digit and chunk of events. Its prefix sum, over digits first and chunks second, says where
/// each chunk writes; no place depends on who came first.
class BlockSort {
 public:
  /// What depends on the log's memory. Made anew when the log grows.
  struct Memory {
    vulkan::Buffer table;
    PrefixSum::Source prefix;
    struct Pass {
      vulkan::BoundKernel count, write;
    };
    Pass passes[2];  ///< from the log to its scratch buffer, and back
  };

  void build(PipelineBuilder& builder, const BlockGrid& grid, uint64_t most_events);
  void bind(PipelineBuilder& builder, Memory& target, const EventLog& log,
            const EventLogMemory& memory) const;

  /// Which buffer of the log holds the sorted events.
  EventLog::From sorted() const { return passes_ == 1 ? EventLog::From::scratch : EventLog::From::events; }
  /// Sorts the first `events` events of the log, or as many as there are.
  void record(vulkan::Commands& commands, const Memory& memory, uint32_t events) const;

 private:
  uint32_t chunks_of(uint64_t events) const;

  BlockGrid grid_;
  uint32_t passes_ = 1;
  uint32_t digits_ = 1;
  uint32_t chunk_events_ = 1;
  PrefixSum prefix_;
  vulkan::Kernel count_, write_;
};

}  // namespace scarf
