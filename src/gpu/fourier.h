// Discrete Fourier transforms of planes in double precision on a device.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/pipeline_builder.h"
#include "scarf/event.h"
#include "vulkan/commands.h"

namespace scarf {

/// Transforms a plane of complex numbers (two doubles each), of any size, without a scale. The time grows with
/// the prime factors of width and height.
class Fourier {
 public:
  void build(PipelineBuilder& builder, SensorSize size);

  /// Where the plane is: two buffers take turns.
  const vulkan::Buffer& plane(uint32_t turn) const { return planes_[turn]; }
  /// Passes change turns, forward and inverse alike.
  uint32_t passes() const { return static_cast<uint32_t>(columns_.radices.size() + rows_.radices.size()); }

  /// Transforms the plane of this turn; returns the turn of the result.
  uint32_t record(vulkan::Commands& commands, uint32_t turn, bool inverse) const;

 private:
  struct Axis {
    uint32_t points = 1;
    uint32_t stride = 1;  // elements from one point to the next
    std::vector<uint32_t> radices;
    vulkan::Buffer roots;
    vulkan::BoundKernel from[2];  // by turn
  };

  void build_axis(PipelineBuilder& builder, Axis& axis, uint32_t points, uint32_t stride);

  uint32_t elements_ = 0;
  vulkan::Buffer planes_[2];
  Axis columns_, rows_;
  vulkan::Kernel kernel_;
};

}  // namespace scarf
