// Prefix sums on the device against sums on the host.
#include "kernels/scan.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <random>

#include "shaders/kernels/scan_layout.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

constexpr uint32_t kBlock = layout::kPrefixBlock;

std::vector<uint32_t> random_words(size_t count, uint32_t below, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint32_t> words(count);
  for (uint32_t& word : words)
    word = static_cast<uint32_t>(below == 0 ? static_cast<uint32_t>(random()) : random() % below);
  return words;
}

class Scan : public test::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    commands_ = test::value_of(Commands::create(context_->vulkan(), context_->vulkan().compute()));
  }

  // A buffer of the host, which shaders sum in place.
  Buffer buffer_of(const std::vector<uint32_t>& words) {
    Buffer buffer = test::value_of(
        Buffer::create(context_->vulkan(), "test", words.size() * sizeof(uint32_t), MemoryUse::readback));
    std::memcpy(buffer.mapped(), words.data(), words.size() * sizeof(uint32_t));
    return buffer;
  }

  // Sums the first `count` words, or fewer if `length` says so, and compares all of them.
  void compare(std::vector<uint32_t> words, uint64_t most_words, uint32_t count,
               std::optional<uint32_t> length = {}) {
    SCOPED_TRACE(count);
    const Buffer buffer = buffer_of(words);
    const Buffer limit = buffer_of({length.value_or(0)});
    PrefixSum sum;
    PrefixSum::Source source;
    PipelineBuilder builder(context_->vulkan());
    sum.build(builder, most_words);
    sum.bind(builder, source, buffer, length ? &limit : nullptr);
    ASSERT_TRUE(builder.result()) << builder.result().error().message;
    ASSERT_TRUE(commands_.begin());
    sum.record(commands_, source, count);
    ASSERT_TRUE(commands_.submit() && commands_.wait());

    const auto end = words.begin() + std::min(count, length.value_or(count));
    std::exclusive_scan(words.begin(), end, words.begin(), uint32_t{0});
    const uint32_t* sums = buffer.mapped_as<uint32_t>();
    for (size_t i = 0; i < words.size(); ++i) ASSERT_EQ(sums[i], words[i]) << i;
  }

  Commands commands_;
};

TEST_F(Scan, SizesAroundBlocks) {
  for (uint32_t count : {0u, 1u, 2u, 15u, 16u, 17u, 255u, 257u, kBlock - 1, kBlock, kBlock + 1, 3 * kBlock}) {
    ASSERT_NO_FATAL_FAILURE(compare(random_words(count + 5, 100, count), count + 5, count));
  }
}

TEST_F(Scan, SumsWrapAround) {
  ASSERT_NO_FATAL_FAILURE(compare(random_words(20'000, 0, 1), 20'000, 20'000));
}

TEST_F(Scan, FewerWordsThanThereIsRoomFor) {
  for (uint32_t count : {0u, 7u, kBlock, kBlock + 1}) {
    ASSERT_NO_FATAL_FAILURE(compare(random_words(5 * kBlock, 9, count), 5 * kBlock, count));
  }
}

TEST_F(Scan, LengthsThatOnlyTheDeviceKnows) {
  for (uint32_t length : {0u, 1u, kBlock - 1, kBlock, kBlock + 1, 3 * kBlock + 77, 4 * kBlock, UINT32_MAX}) {
    ASSERT_NO_FATAL_FAILURE(compare(random_words(4 * kBlock, 9, length), 4 * kBlock, 4 * kBlock, length));
  }
}

TEST_F(Scan, AsManyWordsAsASensorHasPixels) {
  ASSERT_NO_FATAL_FAILURE(compare(random_words(1280 * 720, 2, 2), 1280 * 720, 1280 * 720));
}

// One word more than the blocks of a single level hold: three levels.
TEST_F(Scan, ThreeLevels) {
  const uint32_t count = kBlock * kBlock + 1;
  if (context_->vulkan().limits().storage_range < count * sizeof(uint32_t)) GTEST_SKIP();
  ASSERT_NO_FATAL_FAILURE(compare(random_words(count, 3, 3), count, count));
}

}  // namespace
}  // namespace scarf
