// Device contexts for tests: validation on, memory poisoned, and any message fails the test. They pose as
// SCARF_TEST_POSE says.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "scarf/device/stream.h"
#include "scarf/reference/reference.h"
#include "tests/support/posed_device.h"
#include "tests/support/same.h"

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

  void open(const DeviceOptions& options, const Pose& pose = pose_of_environment()) {
    context_ = value_of(create_context(options, {}, pose));
  }

  void TearDown() override {
    if (context_ == nullptr) return;
    for (const std::string& message : context_->validation_messages()) ADD_FAILURE() << message;
  }

  std::unique_ptr<GpuScarf> device_scarf(const Geometry& geometry, const GpuOptions& options = {}) {
    return value_of(make_gpu_scarf(context_, geometry, kDefaultAccumulation, options));
  }

  static std::unique_ptr<Scarf> reference_scarf(const Geometry& geometry) {
    return value_of(make_reference_scarf(geometry));
  }

  std::shared_ptr<GpuContext> context_;
};

}  // namespace scarf::test
