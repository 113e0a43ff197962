#include "kernels/tone.h"

#include <algorithm>
#include <vector>

#include "compiled_shaders/shaders.h"

namespace scarf {

void Tone::build(PipelineBuilder& builder, const Levels& levels, uint64_t most_pixels) {
  const std::vector<uint32_t> u8(levels.u8.begin(), levels.u8.end());
  first_levels_.last_level = static_cast<uint32_t>(u8.size() - 1);
  for (uint32_t i = 0; i < layout::kPushedLevels; ++i) {
    const uint32_t level = u8[std::min<size_t>(i, u8.size() - 1)];
    (i < 4 ? first_levels_.levels_0_to_3 : first_levels_.levels_4_to_7) |= level << 8 * (i % 4);
  }
  builder.table<uint32_t>(levels_u8_, "the 8-bit levels", u8);
  builder.table<float>(levels_float_, "the float levels", levels.f32);
  builder.buffer(picture_, "the image", most_pixels * sizeof(float));
  builder.kernel(u8_, "tone_u8", shaders::tone_u8,
                 {vulkan::View::vectors, vulkan::View::words, vulkan::View::storage},
                 sizeof(layout::TonePush));
  builder.kernel(f32_, "tone_float", shaders::tone_float,
                 {vulkan::View::words, vulkan::View::words, vulkan::View::storage}, sizeof(layout::TonePush));
}

void Tone::bind(PipelineBuilder& builder, Source& source, const vulkan::Buffer& numbers) const {
  builder.bind(source.u8, u8_, {&numbers, &levels_u8_, &picture_});
  builder.bind(source.f32, f32_, {&numbers, &levels_float_, &picture_});
}

void Tone::record_u8(vulkan::Commands& commands, const Source& source, uint64_t pixels) const {
  constexpr uint64_t kPixelsPerInvocation = 4;
  const uint64_t invocations = (pixels + kPixelsPerInvocation - 1) / kPixelsPerInvocation;
  commands.dispatch(source.u8, invocations, layout::kLinearGroup, push(pixels));
  commands.barrier();
  commands.mark("tone");
}

void Tone::record_float(vulkan::Commands& commands, const Source& source, uint64_t pixels) const {
  commands.dispatch(source.f32, pixels, layout::kLinearGroup, push(pixels));
  commands.barrier();
  commands.mark("tone");
}

layout::TonePush Tone::push(uint64_t pixels) const {
  layout::TonePush push = first_levels_;
  push.pixels = static_cast<uint32_t>(pixels);
  return push;
}

}  // namespace scarf
