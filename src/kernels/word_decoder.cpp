#include "kernels/word_decoder.h"

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"

namespace scarf {

using layout::kDecodeBlock;
using layout::kDecodeGroup;
using vulkan::Buffer;
using vulkan::Commands;

void WordDecoder::build(PipelineBuilder& b, CameraWords words, SensorSize sensor, uint32_t most_words,
                        uint32_t most_events) {
  words_ = words;
  sensor_ = sensor;
  most_words_ = most_words;
  b.buffer(carry_, "the state of the decoder", sizeof(layout::DecodeCarry));
  b.buffer(events_, "the decoded events", uint64_t{most_events} * sizeof(Event));
  const uint32_t format[] = {words == CameraWords::evt2 ? layout::kDecodeEvt2 : layout::kDecodeEvt3};
  const size_t push_bytes = sizeof(layout::DecodePush);
  b.kernel(skip_, "decode_skip", shaders::decode_skip, 3, push_bytes, format);
  b.kernel(skip_scan_, "decode_skip_scan", shaders::decode_skip_scan, 2, push_bytes);
  b.kernel(fold_, "decode_fold", shaders::decode_fold, 5, push_bytes, format);
  b.kernel(scan_, "decode_scan", shaders::decode_scan, 3, push_bytes, format);
  b.kernel(count_, "decode_count", shaders::decode_count, 7, push_bytes, format);
  b.kernel(total_, "decode_total", shaders::decode_total, 4, push_bytes);
  b.kernel(write_, "decode_write", shaders::decode_write, 8, push_bytes, format);
}

void WordDecoder::make_piece(PipelineBuilder& b, Piece& p) const {
  b.staged(p.words, "the staging memory of words", "the memory of words",
           uint64_t{most_words_} * word_bytes(words_));
  const uint64_t blocks = ceil_div(uint64_t{most_words_}, kDecodeBlock);
  const uint64_t lanes = blocks * kDecodeGroup;
  b.buffer(p.lane_skips, "the skips of runs", lanes * sizeof(uint32_t));
  b.buffer(p.lane_summaries, "the summaries of runs", lanes * sizeof(layout::DecodeSummary));
  b.buffer(p.lane_places, "the places of runs", lanes * sizeof(uint32_t));
  b.buffer(p.block_skips, "the skips of blocks", blocks * sizeof(uint32_t));
  b.buffer(p.block_summaries, "the summaries of blocks", blocks * sizeof(layout::DecodeSummary));
  b.buffer(p.block_states, "the states of blocks", blocks * sizeof(layout::DecodeState));
  b.buffer(p.block_facts, "the facts of blocks", blocks * sizeof(layout::DecodeFacts));
  b.buffer(p.block_places, "the places of blocks", blocks * sizeof(uint32_t));
  b.readback(p.result, "the facts of words", sizeof(layout::DecodeResult));
  const Buffer* const words = &p.words.for_shaders();
  b.bind(p.skip, skip_, {words, &p.lane_skips, &p.block_skips});
  b.bind(p.skip_scan, skip_scan_, {&p.block_skips, &carry_});
  b.bind(p.fold, fold_, {words, &p.lane_skips, &p.block_skips, &p.lane_summaries, &p.block_summaries});
  b.bind(p.scan, scan_, {&p.block_summaries, &p.block_states, &carry_});
  b.bind(p.count, count_,
         {words, &p.lane_skips, &p.block_skips, &p.lane_summaries, &p.block_states, &p.lane_places,
          &p.block_facts});
  b.bind(p.total, total_, {&p.block_facts, &p.block_places, &p.result, &carry_});
  b.bind(p.write, write_,
         {words, &p.lane_skips, &p.block_skips, &p.lane_summaries, &p.block_states, &p.lane_places,
          &p.block_places, &events_});
}

layout::DecodePush WordDecoder::push(uint32_t words) const {
  layout::DecodePush push{};
  push.words = words;
  push.blocks = ceil_div(words, kDecodeBlock);
  push.width = static_cast<uint32_t>(sensor_.width);
  push.height = static_cast<uint32_t>(sensor_.height);
  return push;
}

void WordDecoder::record_reset(Commands& commands) const {
  commands.fill(carry_, 0);
  commands.barrier();
}

void WordDecoder::record_pass(Commands& commands, const Piece& piece, uint32_t words, Pass pass) const {
  const layout::DecodePush p = push(words);
  const auto dispatch = [&](const vulkan::BoundKernel& kernel, uint32_t workgroups) {
    commands.dispatch(kernel, uint64_t{workgroups} * kDecodeGroup, kDecodeGroup, p);
    commands.barrier();
  };
  switch (pass) {
    case Pass::skip:
      return dispatch(piece.skip, p.blocks);
    case Pass::skip_scan:
      return dispatch(piece.skip_scan, 1);
    case Pass::fold:
      return dispatch(piece.fold, p.blocks);
    case Pass::scan:
      return dispatch(piece.scan, 1);
    case Pass::count:
      return dispatch(piece.count, p.blocks);
    case Pass::total:
      return dispatch(piece.total, 1);
  }
}

void WordDecoder::record_count(Commands& commands, const Piece& piece, uint32_t words) const {
  for (const Pass pass : {Pass::skip, Pass::skip_scan, Pass::fold, Pass::scan, Pass::count, Pass::total}) {
    const bool skips = pass == Pass::skip || pass == Pass::skip_scan;
    if (!skips || words_ == CameraWords::evt2) record_pass(commands, piece, words, pass);
  }
  commands.mark("decode");
}

void WordDecoder::record_write(Commands& commands, const Piece& piece, uint32_t words, uint32_t first,
                               uint32_t count) const {
  layout::DecodePush p = push(words);
  p.first_event = first;
  p.events = count;
  commands.dispatch(piece.write, uint64_t{p.blocks} * kDecodeGroup, kDecodeGroup, p);
  commands.barrier();
  commands.mark("decode");
}

}  // namespace scarf
