// Twins of shaders/decode/decode_skip.comp and decode_skip_scan.comp.
#include <array>

#include "cpu_ref/stages/decode/decode.h"

namespace scarf::stages {

void decode_skip(const DecodeInput& input, std::span<uint32_t> lane_skips, std::span<uint32_t> block_skips) {
  constexpr uint32_t kNumbers = layout::kDecodeImuSkip + 1;
  for (uint32_t block = 0; block < input.push.blocks; ++block) {
    std::array<uint32_t, kNumbers> skip{};
    for (uint32_t s = 0; s < kNumbers; ++s) skip[s] = s;
    const auto map = [&] {
      uint32_t nibbles = 0;
      for (uint32_t s = 0; s < kNumbers; ++s) nibbles |= skip[s] << 4 * s;
      return nibbles;
    };
    for (uint32_t k = 0; k < layout::kDecodeBlock; ++k) {
      const uint32_t i = block * layout::kDecodeBlock + k;
      if (k % layout::kDecodeRun == 0) lane_skips[i / layout::kDecodeRun] = map();
      if (i >= input.push.words) continue;
      for (uint32_t& s : skip) {
        const bool imu = s == 0 && input.words[i] >> 28 == 0xD;
        s = imu ? layout::kDecodeImuSkip : s - (s > 0 ? 1 : 0);
      }
    }
    block_skips[block] = map();
  }
}

void decode_skip_scan(std::span<uint32_t> block_skips, layout::DecodeCarry& carry) {
  for (uint32_t& block : block_skips) {
    const uint32_t behind = block >> 4 * carry.skip & 7;
    block = carry.skip;
    carry.skip = behind;
  }
}

}  // namespace scarf::stages
