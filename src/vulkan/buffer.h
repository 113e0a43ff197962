// Device memory, by what it is for.
#pragma once

#include <cstdint>

#include "vulkan/device.h"

namespace scarf::vulkan {

enum class MemoryUse {
  device,    ///< read and written by shaders and copies only
  upload,    ///< written by the host, read by the device (and by the host, which checks it)
  readback,  ///< written by the device, read by the host
};

/// A storage buffer with memory of its own. Movable; destroyed buffers must be out of use on the device.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer();

  /// Errors: out_of_memory, naming `name` and the size.
  static Result<Buffer> create(const Device& device, const char* name, uint64_t bytes, MemoryUse use);

  VkBuffer handle() const { return buffer_; }
  uint64_t size() const { return size_; }
  /// What shaders are given. In poisoned memory the guard bytes too: else a driver that checks bounds would
  /// drop what a shader writes beyond the end, and nobody would notice.
  uint64_t bound_bytes() const;
  /// Host address; null for MemoryUse::device. Coherent: no flushes are needed.
  void* mapped() const { return mapped_; }
  template <class T>
  T* mapped_as() const {
    return static_cast<T*>(mapped_);
  }
  /// Whether the memory is as fast for the device as its own.
  bool device_local() const { return device_local_; }

 private:
  void swap(Buffer& other) noexcept;
  void poison();
  bool guards_intact() const;

  const Device* device_ = nullptr;
  const char* name_ = "";
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  uint64_t size_ = 0;
  void* mapped_ = nullptr;
  uint8_t* guarded_ = nullptr;  // host address in poisoned memory, where there is one
  bool device_local_ = false;
};

}  // namespace scarf::vulkan
