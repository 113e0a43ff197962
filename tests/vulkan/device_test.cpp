// Choosing a device, saying why not, memory and its guards.
#include "vulkan/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tests/support/context.h"
#include "tests/support/same.h"
#include "vulkan/buffer.h"
#include "vulkan/commands.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

Result<std::shared_ptr<GpuContext>> open(const std::string& selector, bool require_gpu = false) {
  DeviceOptions options;
  options.device = selector;
  options.require_gpu = require_gpu;
  options.cache_folder = "-";
  return GpuContext::create(options);
}

// The first device of the list, which the other tests choose by its properties.
DeviceInfo first() {
  return test::value_of(list_devices()).at(0);
}

TEST(DeviceChoice, ListIsRankedAndNumbered) {
  const auto devices = test::value_of(list_devices());
  ASSERT_FALSE(devices.empty());
  for (size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, i);
    EXPECT_EQ(devices[i].uuid.size(), 32u);
    EXPECT_FALSE(devices[i].name.empty());
  }
  const auto cpu = [](const DeviceInfo& d) { return d.rejected.empty() && d.type == "cpu"; };
  const auto gpu = [](const DeviceInfo& d) { return d.rejected.empty() && d.type == "discrete"; };
  const auto first_cpu = std::find_if(devices.begin(), devices.end(), cpu);
  EXPECT_TRUE(std::find_if(first_cpu, devices.end(), gpu) == devices.end());
}

TEST(DeviceChoice, ByIndexNamePartUuidAndType) {
  const DeviceInfo device = first();
  for (const std::string& selector :
       {std::string(), std::string("0"), device.name, device.name.substr(1, 4), device.uuid, device.type}) {
    const auto context = open(selector);
    ASSERT_TRUE(context) << selector << ": " << context.error().message;
    EXPECT_EQ((*context)->device().uuid, device.uuid) << selector;
  }
}

TEST(DeviceChoice, NoMatchListsWhatThereIs) {
  const auto context = open("nonesuch");
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::device);
  EXPECT_NE(context.error().message.find("no device matches 'nonesuch'; there are: 0: " + first().name),
            std::string::npos)
      << context.error().message;
}

TEST(DeviceChoice, ByEnvironmentVariable) {
  setenv("SCARF_DEVICE", "nonesuch", 1);
  EXPECT_FALSE(open(""));
  EXPECT_TRUE(open("0")) << "the option comes first";
  unsetenv("SCARF_DEVICE");
}

TEST(DeviceChoice, ARequiredGpuIsNeverACpu) {
  const auto context = open("cpu", /*require_gpu=*/true);
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::device);
  setenv("SCARF_REQUIRE_GPU", "1", 1);
  EXPECT_FALSE(open("cpu"));
  unsetenv("SCARF_REQUIRE_GPU");
}

TEST(PipelineCache, IsWrittenAndReadAgain) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "scarf_pipeline_cache";
  std::filesystem::remove_all(folder);
  DeviceOptions options;
  options.cache_folder = folder.string();
  const Geometry geometry = *make_geometry(Preset::paper, {32, 24});
  for (int run = 0; run < 2; ++run) {
    const auto context = GpuContext::create(options);
    ASSERT_TRUE(context);
    ASSERT_TRUE(make_gpu_scarf(*context, geometry));
  }
  ASSERT_FALSE(std::filesystem::is_empty(folder));
  // A damaged cache costs time, not correctness.
  for (const auto& file : std::filesystem::directory_iterator(folder)) std::filesystem::resize_file(file, 10);
  const auto context = GpuContext::create(options);
  ASSERT_TRUE(context);
  EXPECT_TRUE(make_gpu_scarf(*context, geometry));
}

class Memory : public test::DeviceTest {};

TEST_F(Memory, CopiesBothWays) {
  vulkan::Device& device = context_->vulkan();
  auto up = test::value_of(Buffer::create(device, "up", 64, MemoryUse::upload));
  auto local = test::value_of(Buffer::create(device, "local", 64, MemoryUse::device));
  auto down = test::value_of(Buffer::create(device, "down", 64, MemoryUse::readback));
  for (uint32_t i = 0; i < 16; ++i) up.mapped_as<uint32_t>()[i] = i * i;
  auto commands = test::value_of(Commands::create(device, device.compute()));
  ASSERT_TRUE(commands.begin());
  commands.fill(local, 7);
  commands.barrier();
  commands.copy(up, 0, local, 0, 32);
  commands.barrier();
  commands.copy(local, 0, down, 0, 64);
  ASSERT_TRUE(commands.submit());
  ASSERT_TRUE(commands.wait());
  for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(down.mapped_as<uint32_t>()[i], i < 8 ? i * i : 7);
}

TEST_F(Memory, TooMuchIsRefusedByNameAndSize) {
  vulkan::Device& device = context_->vulkan();
  const auto buffer =
      Buffer::create(device, "the haystack", device.limits().storage_range + 16, MemoryUse::device);
  ASSERT_FALSE(buffer);
  EXPECT_EQ(buffer.error().code, ErrorCode::out_of_memory);
  EXPECT_NE(buffer.error().message.find("the haystack needs"), std::string::npos);
}

TEST_F(Memory, WritesBeyondTheEndAreNoticed) {
  {
    auto buffer = test::value_of(Buffer::create(context_->vulkan(), "the victim", 64, MemoryUse::upload));
    buffer.mapped_as<uint8_t>()[64] = 0;
  }
  const auto messages = context_->validation_messages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0], "a shader wrote beyond the end of the victim");
  context_.reset();  // its message was wanted
}

}  // namespace
}  // namespace scarf
