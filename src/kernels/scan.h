// Exclusive prefix sums over 32-bit words in device memory.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/pipeline_builder.h"
#include "vulkan/commands.h"

namespace scarf {

/// Replaces each word by the sum of the words before it (modulo 2^32). For the sum of n words as well, sum
/// n + 1 of which the last is 0 (or anything): it becomes the sum of all.
/// Adding is the same in any order, so the result does not depend on the device. One PrefixSum serves any
/// number of buffers, one after the other: barriers between them are part of record().
class PrefixSum {
 public:
  /// One buffer to be summed.
  struct Source {
    /// Level 0 is the buffer itself, level n + 1 has one sum per block of level n.
    struct Level {
      vulkan::BoundKernel sum;
      vulkan::BoundKernel block;
    };
    std::vector<Level> levels;
  };

  /// Memory for the sums of up to `most_words` words.
  void build(PipelineBuilder& builder, uint64_t most_words);
  /// `length`: a buffer whose first word says how many words are summed at most, for lengths that only the
  /// device knows; the words behind them stay as they are.
  void bind(PipelineBuilder& builder, Source& source, const vulkan::Buffer& words,
            const vulkan::Buffer* length = nullptr) const;

  /// Sums the first `words` words of the source in place; at most `most_words`. What was written before must
  /// be visible (a barrier in front of it is the caller's), the sums are visible to what follows.
  void record(vulkan::Commands& commands, const Source& source, uint32_t words) const;

 private:
  const vulkan::Buffer& sums_of(size_t level) const;

  std::vector<vulkan::Buffer> sums_;  // of level 0, 1, ...: one word per block
  vulkan::Buffer no_limit_, no_offsets_;
  vulkan::Kernel sum_, block_;
};

}  // namespace scarf
