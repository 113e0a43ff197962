#include "device/push_commands.h"

#include <utility>

namespace scarf {

using vulkan::Commands;

Result<std::unique_ptr<PushCommands>> PushCommands::create(vulkan::Device& device, Upload upload) {
  auto made = std::make_unique<PushCommands>();
  auto compute = Commands::create(device, device.compute());
  if (!compute) return compute.error();
  made->compute = std::move(*compute);
  if (upload == Upload::transfer_queue) {
    auto transfer = Commands::create(device, device.transfer());
    if (!transfer) return transfer.error();
    made->transfer = std::move(*transfer);
  }
  return made;
}

Result<void> PushCommands::begin() {
  transferred = 0;
  return compute.begin();
}

Result<void> PushCommands::begin(Upload upload, const std::function<void(Commands&)>& copy) {
  transferred = 0;
  if (upload == Upload::transfer_queue) {
    if (auto r = transfer.wait(); !r) return r;
    if (auto r = transfer.begin(); !r) return r;
    copy(transfer);
    if (auto r = transfer.submit(); !r) return r;
    transferred = transfer.value();
  }
  if (auto r = compute.begin(); !r) return r;
  if (upload == Upload::staged) {
    copy(compute);
    compute.barrier();
    compute.mark("upload");
  }
  return {};
}

Result<void> PushCommands::submit(vulkan::Device& device) {
  return transferred == 0 ? compute.submit() : compute.submit(&device.transfer(), transferred);
}

}  // namespace scarf
