// Makes the buffers and kernels of a pipeline, one after the other.
#pragma once

#include <cstring>
#include <initializer_list>
#include <span>
#include <utility>

#include "kernels/staging.h"
#include "vulkan/buffer.h"
#include "vulkan/kernel.h"

namespace scarf {

/// Remembers the first error and makes nothing after it, so that a pipeline asks once, at the end.
class PipelineBuilder {
 public:
  explicit PipelineBuilder(vulkan::Device& device) : device_(device) {}

  /// Device memory; what is in it is undefined.
  void buffer(vulkan::Buffer& target, const char* name, uint64_t bytes) {
    make(target, [&] { return vulkan::Buffer::create(device_, name, bytes, vulkan::MemoryUse::device); });
    bytes_ += target.size();
  }
  /// Constants that shaders read.
  template <class T>
  void table(vulkan::Buffer& target, const char* name, std::span<const T> content) {
    make(target, [&] {
      return vulkan::Buffer::create(device_, name, content.size_bytes(), vulkan::MemoryUse::upload);
    });
    if (result_) std::memcpy(target.mapped(), content.data(), content.size_bytes());
    bytes_ += target.size();
  }
  /// Memory that the host writes and shaders read.
  void staged(StagedBuffer& target, const char* host_name, const char* device_name, uint64_t bytes) {
    make(target, [&] { return StagedBuffer::create(device_, host_name, device_name, bytes); });
    bytes_ += target.memory_bytes();
  }
  /// Memory that the host writes.
  void upload(vulkan::Buffer& target, const char* name, uint64_t bytes) {
    make(target, [&] { return vulkan::Buffer::create(device_, name, bytes, vulkan::MemoryUse::upload); });
    bytes_ += target.size();
  }
  /// Memory that shaders write and the host reads.
  void readback(vulkan::Buffer& target, const char* name, uint64_t bytes) {
    make(target, [&] { return vulkan::Buffer::create(device_, name, bytes, vulkan::MemoryUse::readback); });
    bytes_ += target.size();
  }
  /// See vulkan::Kernel::create.
  void kernel(vulkan::Kernel& target, const char* name, const vulkan::Shader& shader,
              const vulkan::Bindings& bindings, size_t push_bytes, std::span<const uint32_t> constants = {},
              bool whole_subgroups = false) {
    make(target, [&] {
      return vulkan::Kernel::create(device_, name, shader, bindings, static_cast<uint32_t>(push_bytes),
                                    constants, whole_subgroups);
    });
  }
  void bind(vulkan::BoundKernel& target, const vulkan::Kernel& kernel,
            std::initializer_list<const vulkan::Buffer*> buffers) {
    make(target, [&] { return vulkan::BoundKernel::create(device_, kernel, buffers); });
  }

  vulkan::Device& device() { return device_; }
  const Result<void>& result() const { return result_; }
  /// Sizes of all buffers so far.
  uint64_t bytes() const { return bytes_; }

 private:
  template <class T, class Make>
  void make(T& target, Make made_by) {
    if (!result_) return;
    Result<T> made = made_by();
    if (made)
      target = std::move(*made);
    else
      result_ = made.error();
  }

  vulkan::Device& device_;
  Result<void> result_;
  uint64_t bytes_ = 0;
};

}  // namespace scarf
