// Memory that the host fills and shaders read.
#pragma once

#include <cstdint>

#include "scarf/device/context.h"
#include "vulkan/buffer.h"
#include "vulkan/device.h"

namespace scarf {

/// How it gets to the shaders of a device, if the host memory is this. automatic: they read it themselves.
DeviceOptions::Upload upload_path(vulkan::Device& device, const vulkan::Buffer& host);

struct StagedBuffer {
  vulkan::Buffer host;
  vulkan::Buffer device;  ///< copy of `host`, where shaders do not read host memory

  /// Errors: out_of_memory, naming `host_name` or `device_name`.
  static Result<StagedBuffer> create(vulkan::Device& device, const char* host_name, const char* device_name,
                                     uint64_t bytes);

  const vulkan::Buffer& for_shaders() const { return device.size() == 0 ? host : device; }
  uint64_t memory_bytes() const { return host.size() + device.size(); }
};

}  // namespace scarf
