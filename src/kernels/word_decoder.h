// Decoding of EVT2 and EVT3 words on the device, in passes over all words: what runs of words do to the
// decoder's state is joined to the state in front of each run, then runs count their events, then they write
// them.
#pragma once

#include <cstdint>

#include "kernels/pipeline_builder.h"
#include "kernels/staging.h"
#include "scarf/core/event.h"
#include "scarf/device/decoder.h"
#include "shaders/decode/decode_layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// The state of one decoder in device memory. Words of one submission are a Piece.
class WordDecoder {
 public:
  /// The words of one submission, and what the passes leave for those behind them.
  struct Piece {
    StagedBuffer words;
    vulkan::Buffer lane_skips, lane_summaries, lane_places;
    vulkan::Buffer block_skips, block_summaries, block_states, block_facts, block_places;
    vulkan::Buffer result;  // a layout::DecodeResult
    vulkan::BoundKernel skip, skip_scan, fold, scan, count, total, write;

    const layout::DecodeResult& read_result() const { return *result.mapped_as<layout::DecodeResult>(); }
  };

  static uint32_t word_bytes(CameraWords words) { return words == CameraWords::evt2 ? 4 : 2; }

  /// Pieces of up to `most_words`, events of up to `most_events` at a time.
  void build(PipelineBuilder& builder, CameraWords words, SensorSize sensor, uint32_t most_words,
             uint32_t most_events);
  void make_piece(PipelineBuilder& builder, Piece& piece) const;

  /// Puts the decoder right behind nothing: the next word is the first TIME_HIGH.
  void record_reset(vulkan::Commands& commands) const;
  /// Decodes the first `words` of a piece up to their number of events; the state moves on. Pieces come in
  /// their order.
  void record_count(vulkan::Commands& commands, const Piece& piece, uint32_t words) const;
  /// Writes those of the piece's events on the sensor that are numbered first .. first+count-1 to events(),
  /// from its beginning; visible to what follows. Any time after record_count, in any order.
  void record_write(vulkan::Commands& commands, const Piece& piece, uint32_t words, uint32_t first,
                    uint32_t count) const;

  /// One of record_count's passes, by itself. Skips are made and used by EVT2 only.
  enum class Pass { skip, skip_scan, fold, scan, count, total };
  void record_pass(vulkan::Commands& commands, const Piece& piece, uint32_t words, Pass pass) const;

  const vulkan::Buffer& events() const { return events_; }
  const vulkan::Buffer& carry() const { return carry_; }  ///< a layout::DecodeCarry

 private:
  layout::DecodePush push(uint32_t words) const;

  CameraWords words_ = CameraWords::evt2;
  SensorSize sensor_;
  uint32_t most_words_ = 0;
  vulkan::Buffer carry_, events_;
  vulkan::Kernel skip_, skip_scan_, fold_, scan_, count_, total_, write_;
};

}  // namespace scarf
