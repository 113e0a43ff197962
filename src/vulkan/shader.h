// A compiled shader, as shaders/CMakeLists.txt embeds it.
#pragma once

#include <cstdint>
#include <span>

namespace scarf::vulkan {

/// SPIR-V for both kinds of drivers, see View in vulkan/kernel.h; the same words where the shader has no
/// views.
struct Shader {
  std::span<const uint32_t> storage;  ///< every buffer is a storage buffer
  std::span<const uint32_t> texels;   ///< views are texel buffers
};

}  // namespace scarf::vulkan
