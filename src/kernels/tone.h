// Brightness by table: the picture of an image of whole numbers.
#pragma once

#include <cstdint>

#include "kernels/pipeline_builder.h"
#include "scarf/core/image.h"
#include "shaders/common/layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// Looks numbers up in Levels and writes a picture of at most `most_pixels`. Numbers below 0 count as 0,
/// those beyond the table as its last entry.
class Tone {
 public:
  /// One image of 32-bit numbers.
  struct Source {
    vulkan::BoundKernel u8;
    vulkan::BoundKernel f32;
  };

  void build(PipelineBuilder& builder, const Levels& levels, uint64_t most_pixels);
  void bind(PipelineBuilder& builder, Source& source, const vulkan::Buffer& numbers) const;

  /// The first `pixels` of the source; the result is in picture().
  void record_u8(vulkan::Commands& commands, const Source& source, uint64_t pixels) const;
  void record_float(vulkan::Commands& commands, const Source& source, uint64_t pixels) const;
  const vulkan::Buffer& picture() const { return picture_; }
  /// With the levels of the first numbers.
  const layout::TonePush& first_levels() const { return first_levels_; }

 private:
  layout::TonePush push(uint64_t pixels) const;

  layout::TonePush first_levels_{};
  vulkan::Buffer levels_u8_, levels_float_, picture_;
  vulkan::Kernel u8_, f32_;
};

}  // namespace scarf
