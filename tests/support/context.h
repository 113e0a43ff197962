// Device contexts for tests: validation on, memory poisoned, and any message fails the test.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "scarf/gpu.h"
#include "scarf/reference.h"

namespace scarf::test {

inline DeviceOptions checked_options(DeviceOptions::Upload upload = DeviceOptions::Upload::automatic) {
  DeviceOptions options;
  options.validation = true;
  options.poison_memory = true;
  options.upload = upload;
  return options;
}

/// A fixture with a device of its own, whose messages are checked at the end.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override { open(checked_options()); }

  void open(const DeviceOptions& options) {
    auto context = GpuContext::create(options);
    ASSERT_TRUE(context) << context.error().message;
    context_ = *context;
  }

  void TearDown() override {
    if (context_ == nullptr) return;
    for (const std::string& message : context_->validation_messages()) ADD_FAILURE() << message;
  }

  std::unique_ptr<GpuScarf> device_scarf(const Geometry& geometry, const GpuOptions& options = {}) {
    auto made = make_gpu_scarf(context_, geometry, kDefaultAccumulation, options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : nullptr;
  }

  static std::unique_ptr<Scarf> reference_scarf(const Geometry& geometry) {
    auto made = make_reference_scarf(geometry);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : nullptr;
  }

  std::shared_ptr<GpuContext> context_;
};

}  // namespace scarf::test
