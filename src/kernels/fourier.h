// Discrete Fourier transforms of planes in double precision on a device.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/pipeline_builder.h"
#include "scarf/core/event.h"
#include "vulkan/commands.h"

namespace scarf {

/// Transforms a plane of complex numbers (two doubles each), of any size, without a scale. The time grows
/// with the prime factors of width and height.
class Fourier {
 public:
  void build(PipelineBuilder& builder, SensorSize size);

  /// Where the plane is: two buffers take turns.
  const vulkan::Buffer& plane(uint32_t turn) const { return planes_[turn]; }
  /// Passes change turns, forward and inverse alike.
  uint32_t passes() const { return static_cast<uint32_t>(columns_.passes.size() + rows_.passes.size()); }

  /// Transforms the plane of this turn; returns the turn of the result.
  uint32_t record(vulkan::Commands& commands, uint32_t turn, bool inverse) const;

 private:
  struct Axis {
    uint32_t points = 1;
    uint32_t stride = 1;  // elements from one point to the next
    vulkan::Buffer roots;
    struct Pass {
      uint32_t radix = 1;
      vulkan::BoundKernel from[2];  // by turn
    };
    std::vector<Pass> passes;
  };

  static constexpr uint32_t kMostSmallRadix = 5;

  const vulkan::Kernel& kernel_of(PipelineBuilder& builder, uint32_t radix);
  void build_axis(PipelineBuilder& builder, Axis& axis, uint32_t points, uint32_t stride);

  uint32_t elements_ = 0;
  vulkan::Buffer planes_[2];
  Axis columns_, rows_;
  vulkan::Kernel small_[kMostSmallRadix + 1];  // by radix; only those that are needed
  vulkan::Kernel any_;
};

}  // namespace scarf
