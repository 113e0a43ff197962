// Parts of a command buffer that run side by side.
#include "vulkan/commands.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/context.h"
#include "tests/support/same.h"
#include "vulkan/buffer.h"

namespace scarf {
namespace {

using test::value_of;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

constexpr uint64_t kBytes = 1024;

// A word that is filled in and copied on, with a barrier in front of each copy.
struct Chain {
  std::vector<Buffer> buffers;
  Buffer result;

  Chain(vulkan::Device& device, size_t copies) {
    for (size_t i = 0; i < copies; ++i)
      buffers.push_back(value_of(Buffer::create(device, "test", kBytes, MemoryUse::device)));
    result = value_of(Buffer::create(device, "test", kBytes, MemoryUse::readback));
  }
  void record(Commands& commands, uint32_t word) {
    commands.fill(buffers.front(), word);
    for (size_t i = 0; i < buffers.size(); ++i) {
      commands.barrier();
      commands.mark(i % 2 == 0 ? "even" : "odd");
      commands.copy(buffers[i], 0, i + 1 < buffers.size() ? buffers[i + 1] : result, 0, kBytes);
    }
    commands.mark("end");
  }
};

class CommandParts : public test::DeviceTest {};

TEST_F(CommandParts, KeepTheirOrderWhateverTheOthersDo) {
  vulkan::Device& device = context_->vulkan();
  std::vector<Chain> chains;
  for (const size_t copies : {3, 1, 5}) chains.emplace_back(device, copies);
  Commands commands = value_of(Commands::create(device, device.compute()));
  for (uint32_t round = 0; round < 3; ++round) {  // the second as parts, the others one after the other
    ASSERT_TRUE(commands.begin());
    for (uint32_t i = 0; i < chains.size(); ++i) {
      if (round == 1) commands.begin_part();
      chains[i].record(commands, 100 * round + i);
    }
    ASSERT_TRUE(commands.submit());
    ASSERT_TRUE(commands.wait());
    for (uint32_t i = 0; i < chains.size(); ++i)
      EXPECT_EQ(*chains[i].result.mapped_as<uint32_t>(), 100 * round + i) << i;
    const auto times = value_of(commands.take_times());
    if (times.empty()) continue;  // no timestamps
    // even, odd, end of three chains; or of the steps: even, odd and end, even and end, odd, even, end.
    EXPECT_EQ(times.size(), round == 1 ? 8u : 12u);
  }
}

}  // namespace
}  // namespace scarf
