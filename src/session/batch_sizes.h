// How a stream is cut into batches: never changes a result, which `digest` and `verify` exist to show.
#pragma once

#include <cstddef>
#include <optional>
#include <random>
#include <string>

#include "scarf/core/result.h"

namespace scarf {

inline constexpr size_t kDefaultBatch = 131'072;  ///< events
inline constexpr size_t kMaxBatch = 16'777'216;   ///< events: 256 MiB

/// Sizes of successive batches: all equal, or random from a seed (the same seed gives the same sizes
/// everywhere).
class BatchSizes {
 public:
  static BatchSizes fixed(size_t events) { return BatchSizes(events, std::nullopt); }
  static BatchSizes random(uint64_t seed) { return BatchSizes(kDefaultBatch, seed); }

  /// 1 to kMaxBatch.
  size_t next();

 private:
  BatchSizes(size_t events, std::optional<uint64_t> seed) : events_(events) {
    if (seed) generator_.emplace(*seed);
  }

  size_t events_;
  std::optional<std::mt19937_64> generator_;
};

/// "N", "random" or "random:SEED".
Result<BatchSizes> parse_batch_sizes(const std::string& word);

}  // namespace scarf
