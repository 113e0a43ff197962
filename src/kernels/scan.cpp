#include "kernels/scan.h"

#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "shaders/kernels/scan_layout.h"

namespace scarf {
namespace {

constexpr uint64_t blocks_of(uint64_t words) {
  return (words + layout::kPrefixBlock - 1) / layout::kPrefixBlock;
}

}  // namespace

void PrefixSum::build(PipelineBuilder& builder, uint64_t most_words) {
  const uint32_t everything[] = {UINT32_MAX};
  const uint32_t nothing[] = {0};
  builder.table<uint32_t>(no_limit_, "the limit of prefix sums", everything);
  builder.table<uint32_t>(no_offsets_, "the offsets of prefix sums", nothing);
  for (uint64_t blocks = blocks_of(most_words); blocks > 1; blocks = blocks_of(blocks)) {
    builder.buffer(sums_.emplace_back(), "the sums of blocks", blocks * sizeof(uint32_t));
  }
  builder.kernel(sum_, "scan_sum", shaders::scan_sum, 3, sizeof(layout::PrefixPush));
  builder.kernel(block_, "scan_block", shaders::scan_block, 3, sizeof(layout::PrefixPush));
}

// The last level is a single block, whose sum nobody needs.
const vulkan::Buffer& PrefixSum::sums_of(size_t level) const {
  return level < sums_.size() ? sums_[level] : no_offsets_;
}

void PrefixSum::bind(PipelineBuilder& builder, Source& source, const vulkan::Buffer& words,
                     const vulkan::Buffer* length) const {
  source.levels = std::vector<Source::Level>(sums_.size() + 1);
  for (size_t i = 0; i < source.levels.size(); ++i) {
    const vulkan::Buffer& level_words = i == 0 ? words : sums_[i - 1];
    const vulkan::Buffer& limit = i == 0 && length != nullptr ? *length : no_limit_;
    if (i < sums_.size()) builder.bind(source.levels[i].sum, sum_, {&level_words, &sums_[i], &limit});
    builder.bind(source.levels[i].block, block_, {&level_words, &sums_of(i), &limit});
  }
}

void PrefixSum::record(vulkan::Commands& commands, const Source& source, uint32_t words) const {
  const auto dispatch = [&](const vulkan::BoundKernel& kernel, uint64_t count, bool has_offsets) {
    const layout::PrefixPush push = {static_cast<uint32_t>(count), has_offsets ? 1u : 0u};
    commands.dispatch(kernel, blocks_of(count) * layout::kPrefixGroup, layout::kPrefixGroup, push);
    commands.barrier();
  };
  // Up: sums of blocks, until one block holds all of them. Down: the sums become offsets, level by level.
  std::vector<uint64_t> counts = {words};
  while (counts.back() > layout::kPrefixBlock) {
    dispatch(source.levels[counts.size() - 1].sum, counts.back(), false);
    counts.push_back(blocks_of(counts.back()));
  }
  for (size_t i = counts.size(); i-- > 0;) {
    dispatch(source.levels[i].block, counts[i], i + 1 < counts.size());
  }
}

}  // namespace scarf
