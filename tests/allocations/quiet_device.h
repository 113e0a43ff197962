// A device whose driver's allocations neither count nor fail.
#pragma once

#include <memory>

#include "scarf/device/stream.h"
#include "tests/allocations/failing_new.h"
#include "vulkan/device.h"
#include "vulkan/table.h"

namespace scarf::test {

template <auto Member>
struct Quiet;
template <class Answer, class... Arguments, Answer (VKAPI_PTR* vulkan::Table::*Member)(Arguments...)>
struct Quiet<Member> {
  static inline Answer(VKAPI_PTR* real)(Arguments...) = nullptr;
  static VKAPI_ATTR Answer VKAPI_CALL call(Arguments... arguments) {
    const FailingNew::Pause pause;
    return real(arguments...);
  }
  static void install(vulkan::Table& table) {
    if (table.*Member == nullptr || table.*Member == call) return;
    real = table.*Member;
    table.*Member = call;
  }
};

/// For vulkan::Device::create.
inline void install_quiet(vulkan::Table& table) {
#define SCARF_TEST_INSTALL(name) Quiet<&vulkan::Table::name>::install(table);
  SCARF_VK_GLOBAL_CALLS(SCARF_TEST_INSTALL)
  SCARF_VK_INSTANCE_CALLS(SCARF_TEST_INSTALL)
  SCARF_VK_DEVICE_CALLS(SCARF_TEST_INSTALL)
#undef SCARF_TEST_INSTALL
}

inline Result<std::shared_ptr<GpuContext>> quiet_context(
    DeviceOptions::Upload upload = DeviceOptions::Upload::automatic) {
  return as_result([&]() -> Result<std::shared_ptr<GpuContext>> {
    DeviceOptions options;
    options.upload = upload;
    options.cache_folder = "-";
    auto device = vulkan::Device::create(options, install_quiet);
    if (!device) return device.error();
    return std::make_shared<GpuContext>(std::move(*device));
  });
}

}  // namespace scarf::test
