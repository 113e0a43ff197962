// The commands of a push: bytes on their way to the device, and work on them behind that.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "scarf/device/context.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"

namespace scarf {

struct PushCommands {
  using Upload = DeviceOptions::Upload;

  vulkan::Commands compute;
  vulkan::Commands transfer;  ///< only with Upload::transfer_queue
  uint64_t transferred = 0;   ///< place of the upload in the transfer queue's timeline; 0: there is none

  static Result<std::unique_ptr<PushCommands>> create(vulkan::Device& device, Upload upload);

  /// Begins `compute`: what is recorded there afterwards may read what `copy` writes. Where a transfer queue
  /// copies, that is submitted, and in flight also if something fails later; where nothing is to be copied
  /// (Upload::automatic) `copy` is not called.
  Result<void> begin(Upload upload, const std::function<void(vulkan::Commands&)>& copy);
  /// Begins `compute` for work without an upload.
  Result<void> begin();
  /// Submits `compute`, behind the upload.
  Result<void> submit(vulkan::Device& device);
};

inline vulkan::Commands& compute_of(PushCommands& commands) {
  return commands.compute;
}

}  // namespace scarf
