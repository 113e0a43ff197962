#include "io/base/blocks.h"

#include <algorithm>
#include <span>

namespace scarf {
namespace {

// Hands the next `size` bytes to `take`, in pieces; returns how many there were.
template <class Take>
Result<uint64_t> walk(ByteReader& input, uint64_t size, Take take) {
  uint64_t done = 0;
  while (done < size) {
    if (input.available().empty()) {
      if (input.ended()) break;
      if (const auto refilled = input.refill(); !refilled) return refilled.error();
      continue;
    }
    const auto piece = input.available().first(
        static_cast<size_t>(std::min<uint64_t>(size - done, input.available().size())));
    take(piece);
    input.skip(piece.size());
    done += piece.size();
  }
  return done;
}

}  // namespace

Result<bool> read_block(ByteReader& input, uint64_t size, std::vector<uint8_t>& block) {
  block.clear();
  const auto done = walk(input, size, [&](std::span<const uint8_t> piece) {
    block.insert(block.end(), piece.begin(), piece.end());
  });
  if (!done) return done.error();
  return *done == size;
}

Result<uint64_t> skip_block(ByteReader& input, uint64_t size) {
  return walk(input, size, [](std::span<const uint8_t>) {});
}

}  // namespace scarf
