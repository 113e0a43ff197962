// CPU twins of the stages that decode camera words: the same buffers in, the same buffers out. Each walks all
// words in order; what the stages join in groups is here a plain walk from the beginning of a block.
#pragma once

#include <cstdint>
#include <span>

#include "scarf/core/event.h"
#include "shaders/decode/decode_layout.h"

namespace scarf::stages {

/// Words of `format` (layout::kDecodeEvt2 or kDecodeEvt3), and the sensor of `push`.
struct DecodeInput {
  uint32_t format;
  std::span<const uint32_t> words;  ///< EVT3: one word per entry as well
  layout::DecodePush push;
};

/// shaders/decode/decode_skip.comp: maps of runs, each from the beginning of its block, and of blocks.
void decode_skip(const DecodeInput& input, std::span<uint32_t> lane_skips, std::span<uint32_t> block_skips);
/// shaders/decode/decode_skip_scan.comp: maps of blocks become numbers, in place.
void decode_skip_scan(std::span<uint32_t> block_skips, layout::DecodeCarry& carry);
/// shaders/decode/decode_fold.comp: summaries of runs, each from the beginning of its block, and of blocks.
void decode_fold(const DecodeInput& input, std::span<const uint32_t> lane_skips,
                 std::span<const uint32_t> block_skips, std::span<layout::DecodeSummary> lane_summaries,
                 std::span<layout::DecodeSummary> block_summaries);
/// shaders/decode/decode_scan.comp: the state in front of each block.
void decode_scan(uint32_t format, std::span<const layout::DecodeSummary> block_summaries,
                 std::span<layout::DecodeState> block_states, layout::DecodeCarry& carry);
/// shaders/decode/decode_count.comp: places of runs, each from the beginning of its block, and facts of
/// blocks.
void decode_count(const DecodeInput& input, std::span<const uint32_t> block_skips,
                  std::span<const layout::DecodeState> block_states, std::span<uint32_t> lane_places,
                  std::span<layout::DecodeFacts> block_facts);
/// shaders/decode/decode_total.comp
void decode_total(std::span<const layout::DecodeFacts> block_facts, std::span<uint32_t> block_places,
                  layout::DecodeResult& result, const layout::DecodeCarry& carry);
/// shaders/decode/decode_write.comp, for the events of push.
void decode_write(const DecodeInput& input, std::span<const uint32_t> block_skips,
                  std::span<const layout::DecodeState> block_states, std::span<Event> events);

}  // namespace scarf::stages
