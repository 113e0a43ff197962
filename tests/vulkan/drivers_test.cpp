// Drivers unlike the one at hand, made of it by other answers to Vulkan calls: what is accepted, what is
// refused by name, and what they are asked for.
#include <gtest/gtest.h>

#include <cstring>
#include <utility>

#include "scarf/reference/reference.h"
#include "tests/support/posed_device.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using test::value_of;
using vulkan::Device;
using vulkan::Table;

DeviceOptions uncached() {
  DeviceOptions options;
  options.cache_folder = "-";
  return options;
}

// A driver that answers and notes what the test wants; one at a time.
struct Driver {
  // Answers.
  static inline VkResult create_instance_result = VK_SUCCESS;
  static inline VkResult enumerate_result = VK_SUCCESS;
  static inline bool no_devices = false;
  static inline uint32_t smallest_subgroup = 0;  // 0: as it is
  static inline bool takes_subgroup_size = true;
  static inline bool full_subgroups = true;
  static inline uint32_t storage_buffers = 0;  // 0: as it is
  static inline const char* instance_extension = nullptr;
  static inline const char* device_extension = nullptr;
  // Notes.
  static inline VkInstanceCreateFlags instance_flags = 0;
  static inline std::vector<std::string> device_extensions;
  static inline int whole_kernels = 0;  // that ask for whole subgroups
  static inline int sized_kernels = 0;  // that ask for a size of subgroups

  static inline Table real;

  static void reset() {
    create_instance_result = enumerate_result = VK_SUCCESS;
    no_devices = false;
    smallest_subgroup = storage_buffers = 0;
    takes_subgroup_size = full_subgroups = true;
    instance_extension = device_extension = nullptr;
    instance_flags = 0;
    device_extensions.clear();
    whole_kernels = sized_kernels = 0;
    real = {};
  }

  template <class T>
  static T* in_chain(void* chain, VkStructureType type) {
    for (auto* s = static_cast<VkBaseOutStructure*>(chain); s != nullptr; s = s->pNext) {
      if (s->sType == type) return reinterpret_cast<T*>(s);
    }
    return nullptr;
  }
  static VkResult list(const char* extension, uint32_t* count, VkExtensionProperties* extensions) {
    const uint32_t known = extension == nullptr ? 0 : 1;
    if (extensions != nullptr && known != 0) {
      extensions[0] = {};
      std::strncpy(extensions[0].extensionName, extension, VK_MAX_EXTENSION_NAME_SIZE - 1);
    }
    *count = known;
    return VK_SUCCESS;
  }

  static VKAPI_ATTR VkResult VKAPI_CALL CreateInstance(const VkInstanceCreateInfo* info,
                                                       const VkAllocationCallbacks* callbacks,
                                                       VkInstance* instance) {
    instance_flags = info->flags;
    if (create_instance_result != VK_SUCCESS) return create_instance_result;
    VkInstanceCreateInfo plain = *info;  // the loader may not have what the test says that it has
    plain.flags = 0;
    plain.enabledExtensionCount = 0;
    return real.CreateInstance(&plain, callbacks, instance);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL EnumerateInstanceExtensionProperties(const char*, uint32_t* count,
                                                                             VkExtensionProperties* found) {
    return list(instance_extension, count, found);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL EnumeratePhysicalDevices(VkInstance instance, uint32_t* count,
                                                                 VkPhysicalDevice* devices) {
    if (enumerate_result != VK_SUCCESS) return enumerate_result;
    if (no_devices) *count = 0;
    return no_devices ? VK_SUCCESS : real.EnumeratePhysicalDevices(instance, count, devices);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL EnumerateDeviceExtensionProperties(VkPhysicalDevice, const char*,
                                                                           uint32_t* count,
                                                                           VkExtensionProperties* found) {
    return list(device_extension, count, found);
  }
  static VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties2(VkPhysicalDevice device,
                                                                 VkPhysicalDeviceProperties2* answer) {
    real.GetPhysicalDeviceProperties2(device, answer);
    if (storage_buffers != 0) answer->properties.limits.maxPerStageDescriptorStorageBuffers = storage_buffers;
    auto* control = in_chain<VkPhysicalDeviceSubgroupSizeControlProperties>(
        answer->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES);
    if (control == nullptr) return;
    if (!takes_subgroup_size) control->requiredSubgroupSizeStages = 0;
    if (smallest_subgroup != 0) control->minSubgroupSize = smallest_subgroup;
  }
  static VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFeatures2(VkPhysicalDevice device,
                                                               VkPhysicalDeviceFeatures2* answer) {
    real.GetPhysicalDeviceFeatures2(device, answer);
    auto* features = in_chain<VkPhysicalDeviceVulkan13Features>(
        answer->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    if (features != nullptr && !full_subgroups) features->computeFullSubgroups = VK_FALSE;
  }
  static VKAPI_ATTR VkResult VKAPI_CALL CreateDevice(VkPhysicalDevice physical,
                                                     const VkDeviceCreateInfo* info,
                                                     const VkAllocationCallbacks* callbacks,
                                                     VkDevice* device) {
    device_extensions.assign(info->ppEnabledExtensionNames,
                             info->ppEnabledExtensionNames + info->enabledExtensionCount);
    VkDeviceCreateInfo plain = *info;
    plain.enabledExtensionCount = 0;
    return real.CreateDevice(physical, &plain, callbacks, device);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL CreateComputePipelines(VkDevice device, VkPipelineCache cache,
                                                               uint32_t count,
                                                               const VkComputePipelineCreateInfo* infos,
                                                               const VkAllocationCallbacks* callbacks,
                                                               VkPipeline* made) {
    for (uint32_t i = 0; i < count; ++i) {
      const VkPipelineShaderStageCreateInfo& stage = infos[i].stage;
      whole_kernels += (stage.flags & VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT) != 0;
      sized_kernels +=
          in_chain<VkPipelineShaderStageRequiredSubgroupSizeCreateInfo>(
              const_cast<void*>(stage.pNext),
              VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO) != nullptr;
    }
    return real.CreateComputePipelines(device, cache, count, infos, callbacks, made);
  }

  static void install(Table& table) {
#define REPLACE(call) test::PosedCalls::replace(table.call, &Driver::call, real.call)
    REPLACE(CreateInstance);
    REPLACE(EnumerateInstanceExtensionProperties);
    REPLACE(EnumeratePhysicalDevices);
    REPLACE(EnumerateDeviceExtensionProperties);
    REPLACE(GetPhysicalDeviceProperties2);
    REPLACE(GetPhysicalDeviceFeatures2);
    REPLACE(CreateDevice);
    REPLACE(CreateComputePipelines);
#undef REPLACE
  }
};

class Drivers : public testing::Test {
 protected:
  void SetUp() override { Driver::reset(); }

  static std::string error_of(const Result<std::unique_ptr<Device>>& device) {
    return device ? "" : device.error().message;
  }
  static Result<std::unique_ptr<Device>> create() { return Device::create(uncached(), Driver::install); }
};

constexpr const char* kInstall = "; install a driver (for the CPU: mesa-vulkan-drivers)";

TEST_F(Drivers, WithoutAnyTheMessageSaysWhatToInstall) {
  const auto expect_advice = [](const std::string& why) {
    const std::string wanted = "no Vulkan device found" + why + kInstall;
    const auto device = create();
    EXPECT_EQ(error_of(device), wanted);
    EXPECT_EQ(device.error().code, ErrorCode::device);
    const auto list = vulkan::list(Driver::install);
    ASSERT_FALSE(list);
    EXPECT_EQ(list.error().message, wanted);
  };
  Driver::create_instance_result = VK_ERROR_INCOMPATIBLE_DRIVER;
  expect_advice(" (vkCreateInstance: incompatible driver (-9))");
  Driver::reset();
  Driver::create_instance_result = VK_ERROR_INITIALIZATION_FAILED;
  expect_advice(" (vkCreateInstance: initialization failed (-3))");
  Driver::reset();
  Driver::enumerate_result = VK_ERROR_INITIALIZATION_FAILED;
  expect_advice(" (vkEnumeratePhysicalDevices: initialization failed (-3))");
  Driver::reset();
  Driver::no_devices = true;
  expect_advice("");
}

TEST_F(Drivers, FailuresOfAnotherKindAreReportedAsTheyAre) {
  Driver::enumerate_result = VK_ERROR_OUT_OF_HOST_MEMORY;
  EXPECT_EQ(error_of(create()).find("vkEnumeratePhysicalDevices: out of host memory"), 0u);
}

TEST_F(Drivers, WithOneSubgroupSizeAreNotAskedForIt) {
  for (const bool full : {true, false}) {
    Driver::reset();
    Driver::takes_subgroup_size = false;
    Driver::full_subgroups = full;
    const auto context = std::make_shared<GpuContext>(value_of(create()));
    const Geometry geometry = *make_geometry(Preset::paper, {64, 48});
    const auto device = value_of(make_gpu_scarf(context, geometry));
    EXPECT_EQ(Driver::sized_kernels, 0);
    EXPECT_EQ(Driver::whole_kernels, full ? 2 : 0) << "place and append";
    const auto reference = value_of(make_reference_scarf(geometry));
    const auto events = test::make_stream(test::Spread::uniform, {64, 48}, 5000, 1);
    ASSERT_TRUE(device->push(events));
    ASSERT_TRUE(reference->push(events));
    test::expect_same(*device, *reference);
  }
}

TEST_F(Drivers, WithAChoiceOfSubgroupSizesAreAskedForOne) {
  const auto context = std::make_shared<GpuContext>(value_of(create()));
  value_of(make_gpu_scarf(context, *make_geometry(Preset::paper, {64, 48})));
  EXPECT_EQ(Driver::sized_kernels, 2);
  EXPECT_EQ(Driver::whole_kernels, 2);
}

TEST_F(Drivers, WithSeveralSubgroupSizesAndNoChoiceAreRefused) {
  Driver::takes_subgroup_size = false;
  Driver::smallest_subgroup = 1;
  EXPECT_NE(error_of(create()).find("has subgroups of 1 to "), std::string::npos) << error_of(create());
}

TEST_F(Drivers, WithTooFewStorageBuffersAreRefused) {
  Driver::storage_buffers = 4;
  EXPECT_NE(error_of(create()).find("binds 4 storage buffers to a shader, scarf needs 8"), std::string::npos)
      << error_of(create());
  Driver::storage_buffers = 8;
  EXPECT_TRUE(create());
}

TEST_F(Drivers, OnOtherInterfacesAreFoundAndToldSo) {
  value_of(create());
  EXPECT_EQ(Driver::instance_flags, 0u);
  EXPECT_TRUE(Driver::device_extensions.empty());
  Driver::instance_extension = VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME;
  Driver::device_extension = "VK_KHR_portability_subset";
  value_of(create());
  EXPECT_EQ(Driver::instance_flags, VkInstanceCreateFlags{VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR});
  EXPECT_EQ(Driver::device_extensions, std::vector<std::string>{"VK_KHR_portability_subset"});
}

TEST(Poses, AreWhatTheySay) {
  const auto device = [](const test::Pose& pose) {
    return value_of(test::create_device(uncached(), {}, pose));
  };
  const auto as_it_is = device({});
  if (as_it_is->info().type != "cpu") GTEST_SKIP() << "only CPU devices pose";
  EXPECT_EQ(device({.discrete = true})->info().type, "discrete");
  EXPECT_FALSE(device({.discrete = true})->limits().cpu);
  const auto small = device({.least_limits = true});
  EXPECT_FALSE(small->limits().texel_views);
  EXPECT_EQ(small->limits().workgroups, 65'535u);
  EXPECT_EQ(device({.few_workgroups = true})->limits().workgroups, 4u);
  EXPECT_FALSE(device({.one_subgroup_size = true})->limits().requires_subgroup_size);
}

}  // namespace
}  // namespace scarf
