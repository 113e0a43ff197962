// Every Vulkan call that scarf makes, in one table, so that tests can make any of them fail.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

#include <functional>

#include "scarf/core/result.h"

// clang-format off
#define SCARF_VK_GLOBAL_CALLS(CALL) \
  CALL(EnumerateInstanceVersion) CALL(EnumerateInstanceLayerProperties) CALL(EnumerateInstanceExtensionProperties) \
  CALL(CreateInstance)

#define SCARF_VK_INSTANCE_CALLS(CALL) \
  CALL(DestroyInstance) CALL(EnumeratePhysicalDevices) CALL(GetPhysicalDeviceProperties2) \
  CALL(GetPhysicalDeviceFeatures2) CALL(GetPhysicalDeviceMemoryProperties) \
  CALL(GetPhysicalDeviceQueueFamilyProperties) CALL(EnumerateDeviceExtensionProperties) CALL(CreateDevice) CALL(GetDeviceProcAddr)

#define SCARF_VK_DEVICE_CALLS(CALL) \
  CALL(DestroyDevice) CALL(GetDeviceQueue) CALL(DeviceWaitIdle) \
  CALL(CreateBuffer) CALL(DestroyBuffer) CALL(CreateBufferView) CALL(DestroyBufferView) CALL(GetBufferMemoryRequirements) CALL(AllocateMemory) CALL(FreeMemory) \
  CALL(BindBufferMemory) CALL(MapMemory) \
  CALL(CreateShaderModule) CALL(DestroyShaderModule) CALL(CreateDescriptorSetLayout) \
  CALL(DestroyDescriptorSetLayout) CALL(CreatePipelineLayout) CALL(DestroyPipelineLayout) \
  CALL(CreatePipelineCache) CALL(DestroyPipelineCache) CALL(GetPipelineCacheData) CALL(CreateComputePipelines) \
  CALL(DestroyPipeline) CALL(CreateDescriptorPool) CALL(DestroyDescriptorPool) CALL(AllocateDescriptorSets) \
  CALL(UpdateDescriptorSets) \
  CALL(CreateCommandPool) CALL(DestroyCommandPool) CALL(ResetCommandPool) CALL(AllocateCommandBuffers) \
  CALL(BeginCommandBuffer) CALL(EndCommandBuffer) CALL(CmdBindPipeline) CALL(CmdBindDescriptorSets) \
  CALL(CmdPushConstants) CALL(CmdDispatch) CALL(CmdPipelineBarrier2) CALL(CmdCopyBuffer) CALL(CmdFillBuffer) \
  CALL(CmdResetQueryPool) CALL(CmdWriteTimestamp2) CALL(CreateQueryPool) CALL(DestroyQueryPool) \
  CALL(GetQueryPoolResults) \
  CALL(CreateSemaphore) CALL(DestroySemaphore) CALL(WaitSemaphores) CALL(GetSemaphoreCounterValue) \
  CALL(QueueSubmit2)
// clang-format on

namespace scarf::vulkan {

struct Table {
#define SCARF_VK_DECLARE(name) PFN_vk##name name = nullptr;
  SCARF_VK_GLOBAL_CALLS(SCARF_VK_DECLARE)
  SCARF_VK_INSTANCE_CALLS(SCARF_VK_DECLARE)
  SCARF_VK_DEVICE_CALLS(SCARF_VK_DECLARE)
#undef SCARF_VK_DECLARE
  // The validation layers' messages; null where the extension is off.
  PFN_vkCreateDebugUtilsMessengerEXT CreateDebugUtilsMessengerEXT = nullptr;
  PFN_vkDestroyDebugUtilsMessengerEXT DestroyDebugUtilsMessengerEXT = nullptr;
};

/// Replaces entries of a table; called after each of the three loading steps.
using TableHook = std::function<void(Table&)>;

/// Errors: device, naming the function that the loader or driver lacks.
Result<void> load_global_calls(Table& table);
Result<void> load_instance_calls(Table& table, VkInstance instance);
Result<void> load_device_calls(Table& table, VkDevice device);

}  // namespace scarf::vulkan
