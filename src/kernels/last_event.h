// The last event of each pixel, for the stages that let only it write.
#pragma once

#include <cstdint>

#include "kernels/pipeline_builder.h"
#include "scarf/core/event.h"
#include "shaders/common/surface_layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// One 32-bit stamp per pixel, or per polarity and pixel: the place of its last event in the stream, from 1
/// on. After record(), an event is the last of its pixel if the entry is its own stamp, push.stamp + its
/// place in the submission; smaller entries say that the pixel did not fire since.
class LastEvent {
 public:
  /// `stamp` is that of the first event: 1, but for tests.
  void build(PipelineBuilder& builder, SensorSize sensor, uint32_t planes, uint32_t stamp = 1);
  void bind(PipelineBuilder& builder, vulkan::BoundKernel& bound, const vulkan::Buffer& events) const;

  void record_reset(vulkan::Commands& commands);
  /// Makes sure of stamps for `count` more events: clears the entries when they run out, and waits for it.
  Result<void> make_room(uint32_t count);
  /// Finds the last events of a submission. Returns what the stages that look at entries() are pushed.
  layout::SurfacePush record(vulkan::Commands& commands, const vulkan::BoundKernel& bound, uint32_t first,
                             uint32_t count);

  const vulkan::Buffer& entries() const { return entries_; }

 private:
  SensorSize sensor_;
  uint32_t planes_ = 1;
  uint32_t stamp_ = 1;  // of the next event
  vulkan::Device* device_ = nullptr;
  vulkan::Buffer entries_;
  vulkan::Kernel kernel_;
};

}  // namespace scarf
