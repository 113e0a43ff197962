#include "vulkan/table.h"

#include "core/text.h"

extern "C" VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                                          const char* name);

namespace scarf::vulkan {
namespace {

template <class Function>
Result<void> found(Function& entry, PFN_vkVoidFunction address, const char* name) {
  entry = reinterpret_cast<Function>(address);
  if (entry != nullptr) return {};
  return Error{ErrorCode::device, text("the Vulkan loader or driver has no vk", name,
                                       "; scarf needs Vulkan 1.3: install a newer driver")};
}

}  // namespace

Result<void> load_global_calls(Table& table) {
#define SCARF_VK_LOAD(name) \
  if (auto r = found(table.name, vkGetInstanceProcAddr(nullptr, "vk" #name), #name); !r) return r;
  SCARF_VK_GLOBAL_CALLS(SCARF_VK_LOAD)
#undef SCARF_VK_LOAD
  return {};
}

Result<void> load_instance_calls(Table& table, VkInstance instance) {
#define SCARF_VK_LOAD(name) \
  if (auto r = found(table.name, vkGetInstanceProcAddr(instance, "vk" #name), #name); !r) return r;
  SCARF_VK_INSTANCE_CALLS(SCARF_VK_LOAD)
#undef SCARF_VK_LOAD
  table.CreateDebugUtilsMessengerEXT = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
  table.DestroyDebugUtilsMessengerEXT = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
  return {};
}

Result<void> load_device_calls(Table& table, VkDevice device) {
#define SCARF_VK_LOAD(name) \
  if (auto r = found(table.name, table.GetDeviceProcAddr(device, "vk" #name), #name); !r) return r;
  SCARF_VK_DEVICE_CALLS(SCARF_VK_LOAD)
#undef SCARF_VK_LOAD
  return {};
}

}  // namespace scarf::vulkan
