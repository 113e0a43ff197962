// Packed events (layout/event_packer.h) to events as pipelines bind them, on the device.
#pragma once

#include <cstdint>

#include "kernels/pipeline_builder.h"
#include "scarf/core/event.h"
#include "shaders/decode/unpack_layout.h"
#include "vulkan/commands.h"

namespace scarf {

class EventUnpacker {
 public:
  /// Up to `most_events` at a time.
  void build(PipelineBuilder& builder, uint32_t most_events);
  void bind(PipelineBuilder& builder, vulkan::BoundKernel& bound, const vulkan::Buffer& packed) const;

  /// Writes the events of a part to the beginning of events(); visible to what follows.
  void record(vulkan::Commands& commands, const vulkan::BoundKernel& bound,
              const layout::UnpackPush& part) const;

  const vulkan::Buffer& events() const { return events_; }
  uint64_t memory_bytes() const { return events_.size(); }

 private:
  vulkan::Buffer events_;
  vulkan::Kernel unpack_;
};

}  // namespace scarf
