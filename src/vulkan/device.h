// Instance, device choice, queues and errors: the ground that everything Vulkan stands on.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "scarf/device/context.h"
#include "vulkan/quirks.h"
#include "vulkan/table.h"

namespace scarf::vulkan {

/// What the planners and the memory code need to know about a device.
struct Limits {
  uint64_t storage_range = 0;  ///< bytes of one buffer binding
  bool texel_views =
      false;                ///< kernels see views as texel buffers, which hold whatever a storage buffer does
  uint32_t workgroups = 0;  ///< per axis of a dispatch
  uint32_t subgroup_size = 0;           ///< of kernels that ask for whole subgroups
  bool requires_subgroup_size = false;  ///< they have to ask for that size, or it may be another
  bool full_subgroups = false;          ///< they can ask that no subgroup is partly empty
  uint32_t loop_trips = 0;              ///< see Quirks
  bool lanes_in_step = false;           ///< see Quirks
  bool cpu = false;
  uint32_t cores = 1;           ///< of a CPU device, which gives consecutive workgroups to one of them
  bool float64 = false;         ///< shaders may use doubles
  double timestamp_period = 0;  ///< nanoseconds per tick; 0: no timestamps
  uint64_t timestamp_mask = 0;
};

/// A queue with a timeline: the n-th submission signals n, and n means that all submissions up to it are
/// done.
class Queue {
 public:
  /// Submits a command buffer, after `wait_value` of `wait_queue` if that is given; returns its place in the
  /// timeline.
  Result<uint64_t> submit(VkCommandBuffer commands, const Queue* wait_queue = nullptr,
                          uint64_t wait_value = 0);
  /// Waits until a submission is done.
  Result<void> wait(uint64_t value) const;
  Result<bool> done(uint64_t value) const;
  uint32_t family() const { return family_; }

 private:
  friend class Device;
  class Device* device_ = nullptr;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex* mutex_ = nullptr;  // of the VkQueue, which two Queues may share
  uint32_t family_ = 0;
  VkSemaphore timeline_ = VK_NULL_HANDLE;
  uint64_t last_ = 0;
  mutable std::atomic<uint64_t> known_done_ = 0;
};

class Device {
 public:
  static Result<std::unique_ptr<Device>> create(const DeviceOptions& options, const TableHook& hook = {});
  ~Device();

  const Table& calls() const { return table_; }
  VkDevice handle() const { return device_; }
  const DeviceInfo& info() const { return info_; }
  const Limits& limits() const { return limits_; }
  const DeviceOptions& options() const { return options_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  VkPipelineCache pipeline_cache() const { return cache_; }

  Queue& compute() { return compute_; }
  /// The queue for uploads: a dedicated transfer queue where there is one, else the compute queue's VkQueue.
  Queue& transfer() { return transfer_; }

  /// Turns the result of a call into an error; remembers a lost device, after which every check fails.
  Result<void> check(VkResult result, const char* call) const;

  /// Whether this process was forked from the one that made the device. The driver's threads are not here, so
  /// that to wait would be for ever, and what the device does is the other process's: nothing may be called,
  /// not even to destroy.
  bool forked() const { return getpid() != process_; }
  /// Errors: device, if forked().
  Result<void> check_process() const;

  /// Messages of the validation layers, and of scarf's own memory checks.
  void add_message(const char* message, const char* about = "") const noexcept;
  std::vector<std::string> messages() const;

 private:
  Device() = default;
  Result<void> create_instance(bool validation);
  Result<void> choose();
  Result<void> create_queue(Queue& queue, uint32_t family, std::mutex* mutex);
  Result<void> load_cache();
  void save_cache() const;
  friend Result<std::vector<DeviceInfo>> list(const TableHook& hook);

  const pid_t process_ = getpid();
  DeviceOptions options_;
  TableHook hook_;
  Table table_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::string cache_path_;
  DeviceInfo info_;
  Limits limits_;
  VkPhysicalDeviceMemoryProperties memory_{};
  Queue compute_;
  Queue transfer_;
  std::mutex compute_mutex_;
  std::mutex transfer_mutex_;
  mutable std::atomic<bool> lost_ = false;
  mutable std::mutex messages_mutex_;
  mutable std::vector<std::string> messages_;
  mutable bool message_lost_ = false;  // for lack of memory
};

/// All devices, ranked.
Result<std::vector<DeviceInfo>> list(const TableHook& hook = {});

}  // namespace scarf::vulkan
