// Devices of tests that pose as others, through the table of Vulkan calls, so that code for devices that are
// not at hand runs on the one that is.
#pragma once

#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "scarf/device/stream.h"
#include "vulkan/device.h"
#include "vulkan/table.h"

namespace scarf::test {

/// What a CPU device poses as; other devices stay what they are.
struct Pose {
  /// A discrete GPU, whose host memory is not its own: GPU plans and staged uploads.
  bool discrete = false;
  /// The limits that Vulkan promises every device; workgroups of 256 and 8 storage buffers, which scarf
  /// needs, are more than that.
  bool least_limits = false;
  /// Four workgroups side by side: nearly every dispatch has two dimensions, and is rounded up.
  bool few_workgroups = false;
  /// One subgroup size, which cannot be asked for.
  bool one_subgroup_size = false;
};

/// The pose that the environment variable SCARF_TEST_POSE names: any of discrete, least_limits,
/// few_workgroups and one_subgroup_size, separated by commas.
inline Pose pose_of_environment() {
  Pose pose;
  const char* variable = std::getenv("SCARF_TEST_POSE");
  std::istringstream names(variable == nullptr ? "" : variable);
  for (std::string name; std::getline(names, name, ',');) {
    if (name == "discrete")
      pose.discrete = true;
    else if (name == "least_limits")
      pose.least_limits = true;
    else if (name == "few_workgroups")
      pose.few_workgroups = true;
    else if (name == "one_subgroup_size")
      pose.one_subgroup_size = true;
    else
      throw std::runtime_error("SCARF_TEST_POSE: there is no pose " + name);
  }
  return pose;
}

/// The calls that a posing device answers otherwise.
struct PosedCalls {
  static inline Pose pose;
  static inline PFN_vkGetPhysicalDeviceProperties2 properties = nullptr;
  static inline PFN_vkGetPhysicalDeviceMemoryProperties memory = nullptr;
  static inline PFN_vkGetBufferMemoryRequirements requirements = nullptr;
  static inline PFN_vkAllocateMemory allocate = nullptr;
  static inline uint32_t added_type = UINT32_MAX;  // a memory type that is type 0 under another name

  static VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                                   VkPhysicalDeviceProperties2* answer) {
    properties(device, answer);
    if (answer->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) return;
    if (pose.discrete) answer->properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    VkPhysicalDeviceLimits& limits = answer->properties.limits;
    if (pose.least_limits) {
      limits.maxTexelBufferElements = 65'536;
      limits.maxStorageBufferRange = 1u << 27;
      limits.maxComputeWorkGroupCount[0] = 65'535;
      limits.maxComputeWorkGroupInvocations = 256;
      limits.maxPerStageDescriptorStorageBuffers = 8;
    }
    if (pose.few_workgroups) limits.maxComputeWorkGroupCount[0] = 4;
    if (!pose.one_subgroup_size) return;
    for (auto* s = static_cast<VkBaseOutStructure*>(answer->pNext); s != nullptr; s = s->pNext) {
      if (s->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES) continue;
      auto* control = reinterpret_cast<VkPhysicalDeviceSubgroupSizeControlProperties*>(s);
      control->requiredSubgroupSizeStages = 0;
    }
  }

  // As of a GPU with a large bar: memory of the host, and memory of its own that the host can reach too. So
  // the guards of both can be checked.
  static VKAPI_ATTR void VKAPI_CALL get_memory(VkPhysicalDevice device,
                                               VkPhysicalDeviceMemoryProperties* answer) {
    memory(device, answer);
    if (!pose.discrete || answer->memoryTypeCount != 1) return;
    VkMemoryType* types = answer->memoryTypes;
    types[1] = types[0];
    types[0].propertyFlags &= ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    types[1].propertyFlags &= ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    added_type = answer->memoryTypeCount++;
  }
  static VKAPI_ATTR void VKAPI_CALL get_requirements(VkDevice device, VkBuffer buffer,
                                                     VkMemoryRequirements* answer) {
    requirements(device, buffer, answer);
    if (added_type != UINT32_MAX) answer->memoryTypeBits |= 1u << added_type;
  }
  static VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* wanted,
                                                        const VkAllocationCallbacks* callbacks,
                                                        VkDeviceMemory* allocated) {
    VkMemoryAllocateInfo info = *wanted;
    if (info.memoryTypeIndex == added_type) info.memoryTypeIndex = 0;
    return allocate(device, &info, callbacks, allocated);
  }

  template <class Call>
  static void replace(Call& entry, Call by, Call& real) {
    if (entry != nullptr && entry != by) real = std::exchange(entry, by);
  }
  static void install(vulkan::Table& table) {
    replace(table.GetPhysicalDeviceProperties2, get_properties, properties);
    replace(table.GetPhysicalDeviceMemoryProperties, get_memory, memory);
    replace(table.GetBufferMemoryRequirements, get_requirements, requirements);
    replace(table.AllocateMemory, allocate_memory, allocate);
  }
};

/// A device in a pose; `hook` sees the calls last. There is one pose at a time: a device keeps the one it was
/// made in, as far as its calls after that go.
inline Result<std::unique_ptr<vulkan::Device>> create_device(const DeviceOptions& options,
                                                             const vulkan::TableHook& hook = {},
                                                             const Pose& pose = pose_of_environment()) {
  PosedCalls::pose = pose;
  PosedCalls::added_type = UINT32_MAX;
  return vulkan::Device::create(options, [hook](vulkan::Table& table) {
    PosedCalls::install(table);
    if (hook) hook(table);
  });
}

inline Result<std::shared_ptr<GpuContext>> create_context(const DeviceOptions& options = {},
                                                          const vulkan::TableHook& hook = {},
                                                          const Pose& pose = pose_of_environment()) {
  auto device = create_device(options, hook, pose);
  if (!device) return device.error();
  return std::make_shared<GpuContext>(std::move(*device));
}

}  // namespace scarf::test
