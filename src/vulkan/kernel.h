// Compute pipelines, and the buffers bound to them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "vulkan/buffer.h"
#include "vulkan/device.h"
#include "vulkan/shader.h"

namespace scarf::vulkan {

/// How a kernel sees a buffer. All but `storage` are texel buffers where Limits::texel_views says so, and
/// storage buffers elsewhere: see shaders/common/views.glsl.
enum class View {
  storage,  ///< a storage buffer
  vectors,  ///< read, four words at a time; or a uniform texel buffer (usamplerBuffer)
  words,    ///< read, word by word; likewise
  image,    ///< words, read and written; or a storage texel buffer (uimageBuffer, r32ui)
};

/// The bindings 0, 1, ... of a kernel.
class Bindings {
 public:
  Bindings(uint32_t storage_buffers)  // NOLINT(google-explicit-constructor)
      : views_(storage_buffers, View::storage) {}
  Bindings(std::initializer_list<View> views) : views_(views) {}

  /// Vectors, and behind them storage buffers.
  static Bindings vectors_and(uint32_t storage_buffers) {
    Bindings b(storage_buffers + 1);
    b.views_[0] = View::vectors;
    return b;
  }

  uint32_t count() const { return static_cast<uint32_t>(views_.size()); }
  View operator[](uint32_t binding) const { return views_[binding]; }

 private:
  std::vector<View> views_;
};

/// A compute pipeline over buffers of set 0 and one push-constant block.
class Kernel {
 public:
  Kernel() = default;
  Kernel(Kernel&& other) noexcept { swap(other); }
  Kernel& operator=(Kernel&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Kernel();

  /// `constants` become specialization constants 0, 1, ... With `whole_subgroups` constant 0 is the local
  /// size, a multiple of Limits::subgroup_size, and every subgroup has that size.
  static Result<Kernel> create(const Device& device, const char* name, const Shader& shader,
                               const Bindings& bindings, uint32_t push_bytes,
                               std::span<const uint32_t> constants, bool whole_subgroups = false);

  VkPipeline pipeline() const { return pipeline_; }
  VkPipelineLayout layout() const { return layout_; }
  VkDescriptorSetLayout set_layout() const { return set_layout_; }
  const Bindings& bindings() const { return bindings_; }

 private:
  void swap(Kernel& other) noexcept;

  const Device* device_ = nullptr;
  Bindings bindings_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// A kernel with its buffers: ready to be dispatched. Kernel and buffers must outlive it.
class BoundKernel {
 public:
  BoundKernel() = default;
  BoundKernel(BoundKernel&& other) noexcept { swap(other); }
  BoundKernel& operator=(BoundKernel&& other) noexcept {
    swap(other);
    return *this;
  }
  ~BoundKernel();

  static Result<BoundKernel> create(const Device& device, const Kernel& kernel,
                                    std::initializer_list<const Buffer*> buffers);

  /// Binds another storage buffer in the place of one; the kernel must be out of use on the device.
  void rebind(uint32_t binding, const Buffer& buffer);

  const Kernel& kernel() const { return *kernel_; }
  VkDescriptorSet set() const { return set_; }

 private:
  void swap(BoundKernel& other) noexcept;

  const Device* device_ = nullptr;
  const Kernel* kernel_ = nullptr;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<VkBufferView> views_;
};

}  // namespace scarf::vulkan
