// The public face of a Vulkan device.
#include "scarf/device/context.h"

#include "vulkan/device.h"

namespace scarf {

Result<std::vector<DeviceInfo>> list_devices() {
  return as_result([] { return vulkan::list(); });
}

Result<std::shared_ptr<GpuContext>> GpuContext::create(const DeviceOptions& options) {
  return as_result([&]() -> Result<std::shared_ptr<GpuContext>> {
    auto device = vulkan::Device::create(options);
    if (!device) return device.error();
    return std::make_shared<GpuContext>(std::move(*device));
  });
}

GpuContext::GpuContext(std::unique_ptr<vulkan::Device> device) : device_(std::move(device)) {}
GpuContext::~GpuContext() = default;

const DeviceInfo& GpuContext::device() const {
  return device_->info();
}

std::vector<std::string> GpuContext::validation_messages() const {
  return device_->messages();
}

}  // namespace scarf
