#include "kernels/staging.h"

#include <utility>

namespace scarf {

using vulkan::Buffer;
using vulkan::MemoryUse;
using Upload = DeviceOptions::Upload;

// Shaders read host memory where that is device memory too; elsewhere it is copied, by the transfer queue if
// the device has one.
Upload upload_path(vulkan::Device& device, const Buffer& host) {
  const Upload wish = device.options().upload;
  if (wish != Upload::automatic || host.device_local()) return wish;
  return device.compute().family() == device.transfer().family() ? Upload::staged : Upload::transfer_queue;
}

Result<StagedBuffer> StagedBuffer::create(vulkan::Device& device, const char* host_name,
                                          const char* device_name, uint64_t bytes) {
  StagedBuffer staged;
  auto host = Buffer::create(device, host_name, bytes, MemoryUse::upload);
  if (!host) return host.error();
  staged.host = std::move(*host);
  if (upload_path(device, staged.host) == Upload::automatic) return staged;
  auto copy = Buffer::create(device, device_name, bytes, MemoryUse::device);
  if (!copy) return copy.error();
  staged.device = std::move(*copy);
  return staged;
}

}  // namespace scarf
