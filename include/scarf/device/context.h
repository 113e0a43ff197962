// Vulkan devices, and one in use.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

/// A Vulkan device as scarf sees it.
struct DeviceInfo {
  uint32_t index = 0;       ///< position in list_devices(), which is ranked: the best device first
  std::string name;         ///< as the driver calls it
  std::string type;         ///< "discrete", "integrated", "virtual", "cpu" or "other"
  std::string uuid;         ///< 32 hexadecimal digits
  std::string driver;       ///< driver name and version
  std::string api_version;  ///< "1.3.224"
  uint64_t memory = 0;      ///< bytes of the largest device-local heap
  std::string rejected;     ///< why scarf cannot use it; empty if it can
};

/// All Vulkan devices, ranked discrete > integrated > virtual > CPU, usable ones first.
/// Errors: device, if there is no Vulkan driver at all.
Result<std::vector<DeviceInfo>> list_devices();

struct DeviceOptions {
  /// Index, part of the name, UUID or type of the device. Empty: the environment variable SCARF_DEVICE, and
  /// without that the best-ranked usable device.
  std::string device;
  /// A CPU device (such as lavapipe) is an error. Also set by a non-empty environment variable
  /// SCARF_REQUIRE_GPU.
  bool require_gpu = false;
  /// How events reach the device. automatic: shaders read the staging memory itself where that is device
  /// memory which the host also reads fast; elsewhere events are packed and copied, by a transfer queue if
  /// there is one. The others force a path, so that each can be tested on any device.
  enum class Upload { automatic, staged, transfer_queue } upload = Upload::automatic;
  /// Khronos validation layers on; every message is collected by GpuContext::validation_messages().
  bool validation = false;
  /// Fills fresh device memory with 0xA5 and surrounds buffers with guard words: for tests.
  bool poison_memory = false;
  /// Folder of the pipeline cache. Empty: $XDG_CACHE_HOME/scarf or ~/.cache/scarf. "-": no cache on disk.
  std::string cache_folder;
};

namespace vulkan {
class Device;
}

/// A Vulkan device in use. Any number of streams may share it, from any threads. It belongs to the process
/// that made it: in a forked child every call of the context's streams, groups and so on returns an error
/// (device), and their destructors leave the device alone; the child may make a context of its own.
class GpuContext {
 public:
  /// Errors: device, if no device fits the options; the message lists every device and why it was rejected.
  static Result<std::shared_ptr<GpuContext>> create(const DeviceOptions& options = {});
  ~GpuContext();

  const DeviceInfo& device() const;
  /// What the validation layers said so far; empty is good.
  std::vector<std::string> validation_messages() const;

  /// The Vulkan layer below, for the pipelines of this library.
  vulkan::Device& vulkan() { return *device_; }
  explicit GpuContext(std::unique_ptr<vulkan::Device> device);

 private:
  std::unique_ptr<vulkan::Device> device_;
};

}  // namespace scarf
