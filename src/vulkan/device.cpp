#include "vulkan/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <span>
#include <thread>

#include "core/text.h"
#include "vulkan/pipeline_cache.h"

namespace scarf::vulkan {
namespace {

constexpr uint32_t kApiVersion = VK_API_VERSION_1_3;
constexpr uint32_t kWorkgroupSize = 256;  // the largest of any shader
constexpr uint32_t kStorageBuffers = 8;   // the most of any shader, views included
constexpr VkSubgroupFeatureFlags kSubgroupOperations =
    VK_SUBGROUP_FEATURE_SHUFFLE_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

Error device_error(const std::string& message) {
  return {ErrorCode::device, message};
}

const char* result_name(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialization failed";
    case VK_ERROR_DEVICE_LOST:
      return "device lost";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "memory map failed";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "incompatible driver";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "out of pool memory";
    default:
      return "unexpected result";
  }
}

// Without memory for a sentence the message is shorter.
Error call_error(VkResult result, const char* call) noexcept try {
  const std::string what = text("vk", call, ": ", result_name(result), " (", static_cast<int>(result), ")");
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return {ErrorCode::device_lost, text(what, "; make a new context and start the stream again")};
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_MEMORY_MAP_FAILED:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return {ErrorCode::out_of_memory,
              text(what, "; use a smaller geometry, fewer streams or another device")};
    default:
      return device_error(what);
  }
} catch (const std::bad_alloc&) {
  return {result == VK_ERROR_DEVICE_LOST ? ErrorCode::device_lost : ErrorCode::out_of_memory,
          "out of memory"};
}

// Without a driver, or without the hardware of any driver, there may be an empty list of devices, or no list,
// or not even an instance.
Error no_device(const std::string& why) {
  return device_error(text("no Vulkan device found", why.empty() ? "" : " (", why, why.empty() ? "" : ")",
                           "; install a driver (for the CPU: mesa-vulkan-drivers)"));
}

Error instance_error(VkResult result, const char* call) {
  const Error e = call_error(result, call);
  const bool no_driver = result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED;
  return no_driver ? no_device(e.message) : e;
}

// Whether an extension is among those that a call of two passes, for their number and for them, lists.
template <class List>
Result<bool> has_extension(const char* name, const char* call, List list) {
  uint32_t count = 0;
  if (const VkResult r = list(&count, nullptr); r != VK_SUCCESS) return call_error(r, call);
  std::vector<VkExtensionProperties> extensions(count);
  const VkResult r = list(&count, extensions.data());
  if (r != VK_SUCCESS && r != VK_INCOMPLETE) return call_error(r, call);
  extensions.resize(count);
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int rank(const std::string& type) {
  const char* order[] = {"discrete", "integrated", "virtual", "cpu", "other"};
  return static_cast<int>(std::find(std::begin(order), std::end(order), type) - std::begin(order));
}

std::string version_text(uint32_t v) {
  return text(VK_API_VERSION_MAJOR(v), '.', VK_API_VERSION_MINOR(v), '.', VK_API_VERSION_PATCH(v));
}

std::string hex(const uint8_t* bytes, size_t size) {
  std::string out;
  for (size_t i = 0; i < size; ++i) {
    out += "0123456789abcdef"[bytes[i] >> 4];
    out += "0123456789abcdef"[bytes[i] & 15];
  }
  return out;
}

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

struct Candidate {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  DeviceInfo info;
  VkPhysicalDeviceProperties properties{};
  VkDriverId driver = VK_DRIVER_ID_MAX_ENUM;
  uint32_t subgroup_size = 0;
  bool requires_subgroup_size = false;  // see Limits; likewise the next one
  bool full_subgroups = false;
  bool float64 = false;
  std::vector<VkQueueFamilyProperties> families;
  uint32_t compute_family = 0;
  std::optional<uint32_t> transfer_family;
};

Candidate describe(const Table& calls, VkPhysicalDevice device) {
  Candidate c;
  c.device = device;
  VkPhysicalDeviceSubgroupSizeControlProperties control{};
  control.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES;
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  subgroup.pNext = &control;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &subgroup;
  VkPhysicalDeviceIDProperties id{};
  id.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
  id.pNext = &driver;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &id;
  calls.GetPhysicalDeviceProperties2(device, &properties);
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  VkPhysicalDeviceVulkan13Features features13{};
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features12.pNext = &features13;
  features.pNext = &features12;
  calls.GetPhysicalDeviceFeatures2(device, &features);
  VkPhysicalDeviceMemoryProperties memory{};
  calls.GetPhysicalDeviceMemoryProperties(device, &memory);
  uint32_t families = 0;
  calls.GetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
  c.families.resize(families);
  calls.GetPhysicalDeviceQueueFamilyProperties(device, &families, c.families.data());

  c.properties = properties.properties;
  c.driver = driver.driverID;
  c.subgroup_size = subgroup.subgroupSize;
  // Drivers with one size may have nothing to choose from, and then take no request for it.
  const bool one_size = control.minSubgroupSize == control.maxSubgroupSize;
  c.requires_subgroup_size = features13.subgroupSizeControl == VK_TRUE &&
                             (control.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  c.full_subgroups = features13.computeFullSubgroups == VK_TRUE;
  c.float64 = features.features.shaderFloat64 == VK_TRUE;
  c.info.name = c.properties.deviceName;
  c.info.type = type_name(c.properties.deviceType);
  c.info.uuid = hex(id.deviceUUID, VK_UUID_SIZE);
  c.info.driver = text(driver.driverName, ' ', driver.driverInfo);
  c.info.api_version = version_text(c.properties.apiVersion);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      c.info.memory = std::max<uint64_t>(c.info.memory, memory.memoryHeaps[i].size);
    }
  }

  std::optional<uint32_t> compute;
  for (uint32_t i = 0; i < families; ++i) {
    const VkQueueFlags flags = c.families[i].queueFlags;
    if ((flags & VK_QUEUE_COMPUTE_BIT) && !compute) compute = i;
    const bool only_transfer =
        (flags & VK_QUEUE_TRANSFER_BIT) && !(flags & (VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT));
    if (only_transfer && !c.transfer_family) c.transfer_family = i;
  }
  if (c.properties.apiVersion < kApiVersion) {
    c.info.rejected = text("has Vulkan ", c.info.api_version, ", scarf needs 1.3: install a newer driver");
  } else if (!features.features.shaderInt64) {
    c.info.rejected = "has no 64-bit integers in shaders (shaderInt64)";
  } else if (!features12.storageBuffer8BitAccess) {
    c.info.rejected = "cannot write single bytes in shaders (storageBuffer8BitAccess)";
  } else if ((subgroup.supportedOperations & kSubgroupOperations) != kSubgroupOperations) {
    c.info.rejected = "has no subgroup shuffles and ballots in shaders";
  } else if (c.properties.limits.maxComputeWorkGroupInvocations < kWorkgroupSize) {
    c.info.rejected = text("runs workgroups of ", c.properties.limits.maxComputeWorkGroupInvocations,
                           " invocations, scarf needs ", kWorkgroupSize);
  } else if (c.properties.limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers) {
    c.info.rejected = text("binds ", c.properties.limits.maxPerStageDescriptorStorageBuffers,
                           " storage buffers to a shader, scarf needs ", kStorageBuffers);
  } else if (!c.requires_subgroup_size && !one_size) {
    c.info.rejected = text("has subgroups of ", control.minSubgroupSize, " to ", control.maxSubgroupSize,
                           " invocations and cannot fix their size in compute shaders");
  } else if (!compute) {
    c.info.rejected = "has no compute queue";
  }
  c.compute_family = compute.value_or(0);
  return c;
}

Result<std::vector<Candidate>> candidates(const Table& calls, VkInstance instance) {
  std::vector<VkPhysicalDevice> devices(64);
  auto count = static_cast<uint32_t>(devices.size());
  const VkResult result = calls.EnumeratePhysicalDevices(instance, &count, devices.data());
  if (result != VK_SUCCESS && result != VK_INCOMPLETE)
    return instance_error(result, "EnumeratePhysicalDevices");
  devices.resize(count);
  std::vector<Candidate> found;
  for (VkPhysicalDevice device : devices) found.push_back(describe(calls, device));
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(!a.info.rejected.empty(), rank(a.info.type)) <
           std::pair(!b.info.rejected.empty(), rank(b.info.type));
  });
  for (uint32_t i = 0; i < found.size(); ++i) found[i].info.index = i;
  if (found.empty()) return no_device("");
  return found;
}

bool selected(const DeviceInfo& info, const std::string& selector) {
  uint32_t index = 0;
  const char* end = selector.data() + selector.size();
  if (auto [rest, error] = std::from_chars(selector.data(), end, index);
      error == std::errc{} && rest == end && selector.size() < 5) {
    return info.index == index;
  }
  const std::string wanted = lower(selector);
  return info.type == wanted || info.uuid == wanted || lower(info.name).find(wanted) != std::string::npos;
}

std::string rejections(const std::vector<Candidate>& found) {
  std::string out;
  for (const Candidate& c : found) {
    out += text(out.empty() ? "" : "; ", c.info.index, ": ", c.info.name, " (", c.info.type, ")",
                c.info.rejected.empty() ? "" : " ", c.info.rejected);
  }
  return out;
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data,
                                               void* device) {
  static_cast<const Device*>(device)->add_message(data->pMessage);
  return VK_FALSE;
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::filesystem::path cache_folder(const std::string& option) {
  if (!option.empty()) return option;
  if (const std::string base = environment("XDG_CACHE_HOME"); !base.empty())
    return std::filesystem::path(base) / "scarf";
  if (const std::string home = environment("HOME"); !home.empty())
    return std::filesystem::path(home) / ".cache" / "scarf";
  return "-";
}

}  // namespace

Result<uint64_t> Queue::submit(VkCommandBuffer commands, const Queue* wait_queue, uint64_t wait_value) {
  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = commands;
  VkSemaphoreSubmitInfo wait{};
  wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  wait.value = wait_value;
  VkSemaphoreSubmitInfo signal{};
  signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  signal.semaphore = timeline_;
  signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  if (wait_queue != nullptr) {
    wait.semaphore = wait_queue->timeline_;
    info.waitSemaphoreInfoCount = 1;
    info.pWaitSemaphoreInfos = &wait;
  }
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  info.signalSemaphoreInfoCount = 1;
  info.pSignalSemaphoreInfos = &signal;
  std::lock_guard lock(*mutex_);
  signal.value = last_ + 1;
  if (auto r =
          device_->check(device_->calls().QueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "QueueSubmit2");
      !r) {
    return r.error();
  }
  return ++last_;
}

Result<void> Queue::wait(uint64_t value) const {
  if (value <= known_done_) return {};
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &timeline_;
  info.pValues = &value;
  const VkResult result = device_->calls().WaitSemaphores(device_->handle(), &info, UINT64_MAX);
  if (auto r = device_->check(result, "WaitSemaphores"); !r) return r;
  uint64_t known = known_done_;
  while (known < value && !known_done_.compare_exchange_weak(known, value)) {
  }
  return {};
}

Result<bool> Queue::done(uint64_t value) const {
  if (value <= known_done_) return true;
  uint64_t now = 0;
  const VkResult result = device_->calls().GetSemaphoreCounterValue(device_->handle(), timeline_, &now);
  if (auto r = device_->check(result, "GetSemaphoreCounterValue"); !r) return r.error();
  return value <= now;
}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options, const TableHook& hook) {
  std::unique_ptr<Device> device(new Device);
  device->options_ = options;
  device->hook_ = hook;
  if (device->options_.device.empty()) device->options_.device = environment("SCARF_DEVICE");
  if (!environment("SCARF_REQUIRE_GPU").empty()) device->options_.require_gpu = true;
  if (auto r = device->create_instance(options.validation); !r) return r.error();
  if (auto r = device->choose(); !r) return r.error();
  return device;
}

Result<void> Device::create_instance(bool validation) {
  if (auto r = load_global_calls(table_); !r) return r;
  if (hook_) hook_(table_);
  uint32_t version = 0;
  if (auto r = check(table_.EnumerateInstanceVersion(&version), "EnumerateInstanceVersion"); !r) return r;
  if (version < kApiVersion) {
    return device_error(text("the Vulkan loader has version ", version_text(version),
                             ", scarf needs 1.3: install a newer libvulkan1"));
  }
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "scarf";
  application.apiVersion = kApiVersion;
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = collect_message;
  messenger.pUserData = this;
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enabled;
  features.pNext = &messenger;
  const auto portability =
      has_extension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME, "EnumerateInstanceExtensionProperties",
                    [&](uint32_t* count, VkExtensionProperties* list) {
                      return table_.EnumerateInstanceExtensionProperties(nullptr, count, list);
                    });
  if (!portability) return portability.error();
  std::vector<const char*> extensions;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (*portability) {
    // Else the loader hides drivers that lie on another interface, MoltenVK for one.
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  if (validation) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = table_.CreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    return device_error(
        "validation was asked for, but its layer is missing: install vulkan-validationlayers");
  }
  if (result != VK_SUCCESS) return instance_error(result, "CreateInstance");
  if (auto r = load_instance_calls(table_, instance_); !r) return r;
  if (hook_) hook_(table_);
  if (validation && table_.CreateDebugUtilsMessengerEXT != nullptr) {
    return check(table_.CreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
                 "CreateDebugUtilsMessengerEXT");
  }
  return {};
}

Result<void> Device::choose() {
  auto found = candidates(table_, instance_);
  if (!found) return found.error();
  const std::string& selector = options_.device;
  const auto match = std::find_if(found->begin(), found->end(), [&](const Candidate& c) {
    return selector.empty() ? c.info.rejected.empty() : selected(c.info, selector);
  });
  if (match == found->end()) {
    return device_error(
        text(selector.empty() ? "no device can be used" : text("no device matches '", selector, "'"),
             "; there are: ", rejections(*found)));
  }
  if (!match->info.rejected.empty()) {
    return device_error(text("device ", match->info.name, " cannot be used: it ", match->info.rejected));
  }
  if (options_.require_gpu && match->info.type == "cpu") {
    return device_error(text("a GPU is required, but the device chosen is a CPU (", match->info.name,
                             "); there are: ", rejections(*found)));
  }
  const Candidate& c = *match;
  physical_ = c.device;
  info_ = c.info;
  const VkPhysicalDeviceLimits& l = c.properties.limits;
  const uint32_t timestamp_bits = c.families[c.compute_family].timestampValidBits;
  limits_.storage_range = l.maxStorageBufferRange;
  const Quirks quirks = quirks_of(c.driver);
  // Any storage buffer may be seen as words.
  limits_.texel_views =
      quirks.texel_views && l.maxTexelBufferElements >= l.maxStorageBufferRange / sizeof(uint32_t);
  limits_.workgroups = l.maxComputeWorkGroupCount[0];
  limits_.subgroup_size = c.subgroup_size;
  limits_.requires_subgroup_size = c.requires_subgroup_size;
  limits_.full_subgroups = c.full_subgroups;
  limits_.loop_trips = quirks.loop_trips;
  limits_.lanes_in_step = quirks.lanes_in_step;
  limits_.cpu = c.info.type == "cpu";
  limits_.cores = limits_.cpu ? std::max(1u, std::thread::hardware_concurrency()) : 1;
  limits_.float64 = c.float64;
  limits_.timestamp_period = timestamp_bits == 0 ? 0.0 : l.timestampPeriod;
  limits_.timestamp_mask = timestamp_bits >= 64 ? UINT64_MAX : (uint64_t{1} << timestamp_bits) - 1;
  table_.GetPhysicalDeviceMemoryProperties(physical_, &memory_);

  const float priority = 1.0F;
  std::vector<VkDeviceQueueCreateInfo> queues;
  for (uint32_t family : {c.compute_family, c.transfer_family.value_or(c.compute_family)}) {
    if (!queues.empty() && queues[0].queueFamilyIndex == family) continue;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    queues.push_back(queue);
  }
  VkPhysicalDeviceVulkan13Features features13{};
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features13.synchronization2 = VK_TRUE;
  features13.subgroupSizeControl = c.requires_subgroup_size ? VK_TRUE : VK_FALSE;
  features13.computeFullSubgroups = c.full_subgroups ? VK_TRUE : VK_FALSE;
  features13.maintenance4 = VK_TRUE;  // workgroup sizes as specialization constants
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features12.pNext = &features13;
  features12.timelineSemaphore = VK_TRUE;
  features12.storageBuffer8BitAccess = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features12;
  features.features.shaderInt64 = VK_TRUE;
  features.features.shaderFloat64 = c.float64 ? VK_TRUE : VK_FALSE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features;
  info.queueCreateInfoCount = static_cast<uint32_t>(queues.size());
  info.pQueueCreateInfos = queues.data();
  // Such a driver wants this said. What it lacks, scarf does not use.
  const char* subset = "VK_KHR_portability_subset";
  const auto is_subset = has_extension(
      subset, "EnumerateDeviceExtensionProperties", [&](uint32_t* count, VkExtensionProperties* list) {
        return table_.EnumerateDeviceExtensionProperties(physical_, nullptr, count, list);
      });
  if (!is_subset) return is_subset.error();
  if (*is_subset) {
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &subset;
  }
  if (auto r = check(table_.CreateDevice(physical_, &info, nullptr, &device_), "CreateDevice"); !r) return r;
  if (auto r = load_device_calls(table_, device_); !r) return r;
  if (hook_) hook_(table_);
  if (auto r = create_queue(compute_, c.compute_family, &compute_mutex_); !r) return r;
  const bool shared = !c.transfer_family;
  if (auto r = create_queue(transfer_, c.transfer_family.value_or(c.compute_family),
                            shared ? &compute_mutex_ : &transfer_mutex_);
      !r) {
    return r;
  }
  return load_cache();
}

Result<void> Device::create_queue(Queue& queue, uint32_t family, std::mutex* mutex) {
  queue.device_ = this;
  queue.family_ = family;
  queue.mutex_ = mutex;
  table_.GetDeviceQueue(device_, family, 0, &queue.queue_);
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  return check(table_.CreateSemaphore(device_, &info, nullptr, &queue.timeline_), "CreateSemaphore");
}

// The driver checks that cached pipelines are its own; the file's name keeps those of different drivers
// apart.
Result<void> Device::load_cache() {
  std::vector<uint8_t> bytes;
  const std::filesystem::path folder = cache_folder(options_.cache_folder);
  if (folder != "-") {
    const std::string driver = lower(info_.driver);
    std::string name = info_.uuid;
    for (char ch : driver) name += std::isalnum(static_cast<unsigned char>(ch)) != 0 ? ch : '_';
    cache_path_ = (folder / (name + ".pipelines")).string();
    bytes = load_pipelines(cache_path_);
  }
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = bytes.size();
  info.pInitialData = bytes.empty() ? nullptr : bytes.data();
  return check(table_.CreatePipelineCache(device_, &info, nullptr, &cache_), "CreatePipelineCache");
}

// A cache that cannot be written only costs time, so failures are not errors.
void Device::save_cache() const {
  if (cache_path_.empty() || cache_ == VK_NULL_HANDLE || lost_) return;
  size_t size = 0;
  if (table_.GetPipelineCacheData(device_, cache_, &size, nullptr) != VK_SUCCESS) return;
  if (size > kMaxPipelineCache) return;
  try {
    std::vector<uint8_t> bytes(size);
    if (table_.GetPipelineCacheData(device_, cache_, &size, bytes.data()) != VK_SUCCESS) return;
    save_pipelines(cache_path_, std::span(bytes).first(size));
  } catch (const std::bad_alloc&) {
  }
}

Device::~Device() {
  if (forked()) return;
  if (device_ != VK_NULL_HANDLE) {
    // After a partial start the table may not be loaded, and the device has no work: drivers without hardware
    // may not be able to wait.
    if (transfer_.timeline_ != VK_NULL_HANDLE) table_.DeviceWaitIdle(device_);
    if (cache_ != VK_NULL_HANDLE) {
      try {
        save_cache();
      } catch (const std::exception&) {  // costs time only
      }
      table_.DestroyPipelineCache(device_, cache_, nullptr);
    }
    for (Queue* queue : {&compute_, &transfer_}) {
      if (queue->timeline_ != VK_NULL_HANDLE) table_.DestroySemaphore(device_, queue->timeline_, nullptr);
    }
    if (table_.DestroyDevice != nullptr) table_.DestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) table_.DestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE && table_.DestroyInstance != nullptr)
    table_.DestroyInstance(instance_, nullptr);
}

Result<void> Device::check(VkResult result, const char* call) const {
  if (lost_ && result == VK_SUCCESS) result = VK_ERROR_DEVICE_LOST;
  if (result == VK_SUCCESS) return {};
  if (result == VK_ERROR_DEVICE_LOST) lost_ = true;
  return call_error(result, call);
}

Result<void> Device::check_process() const {
  if (!forked()) return {};
  return Error{ErrorCode::device,
               "this process was forked from the one that made the context; make a context in this one"};
}

void Device::add_message(const char* message, const char* about) const noexcept {
  std::lock_guard lock(messages_mutex_);
  try {
    messages_.push_back(text(message, about));
  } catch (const std::bad_alloc&) {
    message_lost_ = true;
  }
}

std::vector<std::string> Device::messages() const {
  std::lock_guard lock(messages_mutex_);
  std::vector<std::string> all = messages_;
  if (message_lost_) all.emplace_back("a message was lost for lack of memory");
  return all;
}

Result<std::vector<DeviceInfo>> list(const TableHook& hook) {
  Device device;
  device.hook_ = hook;
  if (auto r = device.create_instance(/*validation=*/false); !r) return r.error();
  const auto found = candidates(device.table_, device.instance_);
  if (!found) return found.error();
  std::vector<DeviceInfo> infos;
  for (const Candidate& c : *found) infos.push_back(c.info);
  return infos;
}

}  // namespace scarf::vulkan
