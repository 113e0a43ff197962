// Makes the n-th Vulkan call that can fail, fail.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "scarf/device/stream.h"
#include "tests/support/posed_device.h"
#include "vulkan/device.h"
#include "vulkan/table.h"

namespace scarf::test {

/// Counts the calls that return a VkResult; the one numbered `fail_at` (from 1) returns `result` instead. A
/// lost device stays lost: every later call fails too, but for those that destroy.
struct Faults {
  static inline int calls = 0;
  static inline int fail_at = 0;
  static inline VkResult result = VK_SUCCESS;
  static inline bool lost = false;
  static inline std::function<void()> stop_device;  // a lost device does no more work; set once there is one

  static void arm(int n, VkResult r) {
    calls = 0;
    fail_at = n;
    result = r;
    lost = false;
    stop_device = nullptr;
  }
  static VkResult next() {
    ++calls;
    if (calls == fail_at) {
      lost = result == VK_ERROR_DEVICE_LOST;
      if (lost && stop_device) stop_device();
      return result;
    }
    return lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
  }
};

template <auto Member>
struct Faulty;
template <class... Arguments, VkResult (VKAPI_PTR* vulkan::Table::*Member)(Arguments...)>
struct Faulty<Member> {
  static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    const VkResult injected = Faults::next();
    return injected != VK_SUCCESS ? injected : real(arguments...);
  }
  static void install(vulkan::Table& table) {
    if (table.*Member == nullptr || table.*Member == call) return;
    real = table.*Member;
    table.*Member = call;
  }
};
template <class... Arguments, void (VKAPI_PTR* vulkan::Table::*Member)(Arguments...)>
struct Faulty<Member> {
  static void install(vulkan::Table&) {}
};
template <class... Arguments, PFN_vkVoidFunction (VKAPI_PTR* vulkan::Table::*Member)(Arguments...)>
struct Faulty<Member> {
  static void install(vulkan::Table&) {}
};

/// For create_device().
inline void install_faults(vulkan::Table& table) {
#define SCARF_TEST_INSTALL(name) Faulty<&vulkan::Table::name>::install(table);
  SCARF_VK_GLOBAL_CALLS(SCARF_TEST_INSTALL)
  SCARF_VK_INSTANCE_CALLS(SCARF_TEST_INSTALL)
  SCARF_VK_DEVICE_CALLS(SCARF_TEST_INSTALL)
#undef SCARF_TEST_INSTALL
}

/// A context on a device whose calls can fail. Before it is destroyed, Faults::stop_device must be forgotten.
inline Result<std::shared_ptr<GpuContext>> faulty_context(DeviceOptions::Upload upload) {
  DeviceOptions options;
  options.upload = upload;
  options.cache_folder = "-";
  auto device = create_device(options, install_faults);
  if (!device) return device.error();
  Faults::stop_device = [handle = (*device)->handle()] {
    Faulty<&vulkan::Table::DeviceWaitIdle>::real(handle);
  };
  return std::make_shared<GpuContext>(std::move(*device));
}

/// What a call that failed like this is reported as.
inline ErrorCode reported_as(VkResult result) {
  return result == VK_ERROR_DEVICE_LOST ? ErrorCode::device_lost : ErrorCode::out_of_memory;
}

}  // namespace scarf::test
