// Words on their way into a stream: gathered, decoded, counted, and handed to the stream's pipeline as
// events.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "device/stream.h"
#include "kernels/word_decoder.h"
#include "scarf/device/decoder.h"

namespace scarf {

/// A piece of words goes through three steps: *gathered* in staging memory; *submitted*, that is copied and
/// decoded up to its number of events; *settled*: the host has read that number and what it must know of the
/// times, and has submitted the writing of the events and the pipeline's work on them. A piece is settled
/// when the next one has been submitted, so that the device has work while the host waits.
class WordFeed final : public GpuDecoder {
 public:
  static Result<std::unique_ptr<GpuDecoder>> create(std::shared_ptr<Stream> stream, CameraWords words);
  ~WordFeed() override;

  Result<size_t> push(std::span<const uint8_t> bytes) override;
  size_t max_batch() const override { return capacity_bytes_; }
  Result<ReadReport> report() override;
  Result<std::optional<int64_t>> newest() override;

  // For the stream, which holds its mutex while it calls these.

  /// Whether anything is gathered or submitted.
  bool holds_words() const { return gathered() >= word_bytes_ || !submitted_.empty(); }
  /// Settles all pieces. Errors leave what is not settled as it is: settling goes on there later.
  Result<void> settle_all();
  /// Decodes all pieces, and forgets their events.
  Result<void> discard_all();
  uint64_t memory_bytes() const { return bytes_; }

 private:
  struct Slot {
    WordDecoder::Piece piece;
    uint32_t words = 0;       // submitted
    uint32_t events = 0;      // of the words, once they are read
    uint32_t next_event = 0;  // the first one that the pipeline has not got
    bool read = false;        // the result was read
    uint64_t counted = 0;     // place in the compute timeline where the result is there ...
    uint64_t last_use = 0;    // ... and where the slot may be used again
    uint64_t most_wraps = 0;  // of the clock, in the words
  };

  WordFeed(std::shared_ptr<Stream> stream, CameraWords words);
  Result<void> start();

  Slot& open() { return slots_[open_]; }
  size_t gathered() const { return is_open_ ? fill_ : rest_.size(); }

  Result<void> usable() const;
  Result<void> take(std::span<const uint8_t> bytes, size_t& taken);
  void settled() { submitted_.erase(submitted_.begin()); }
  size_t begin(std::span<const uint8_t> bytes);
  Result<size_t> push_batch(std::span<const uint8_t> bytes);
  uint64_t most_wraps_in(std::span<const uint8_t> bytes) const;
  bool may_be_refused(uint64_t more_wraps) const;
  Result<void> open_slot(GpuOptions::WhenFull when_full);
  Result<void> submit_open();
  Result<void> settle_oldest();
  Result<void> read_result(Slot& slot);
  Result<void> submit_events(Slot& slot);
  Result<std::vector<Event>> events_of(const Slot& slot);

  const std::shared_ptr<Stream> stream_;
  const CameraWords words_;
  const uint32_t word_bytes_;
  uint32_t capacity_bytes_ = 0;  // of a batch
  uint32_t most_events_ = 0;     // of one push of the pipeline
  WordDecoder decoder_;
  std::unique_ptr<EventBinding> binding_;  // of the decoded events
  std::vector<Slot> slots_;
  uint64_t bytes_ = 0;
  bool clear_ = false;         // the decoder's state has been initialised
  bool started_ = false;       // the first TIME_HIGH was met
  bool gap_at_begin_ = false;  // counted there, and none
  bool lost_ = false;          // a push failed half-way: where the words stand is not known
  bool is_open_ = false;       // slot open_ gathers
  size_t open_ = 0;
  size_t fill_ = 0;                // bytes in the open slot
  std::vector<uint8_t> rest_;      // bytes that come before those of the next slot
  std::vector<size_t> submitted_;  // slots not settled yet, oldest first
  uint64_t wraps_ = 0;             // of the clock, up to the last result that was read ...
  uint64_t most_wraps_ahead_ = 0;  // ... and at most in the open slot
  int64_t last_time_ = -1;         // of the last event that was counted; -1: none
  ReadReport report_;
};

}  // namespace scarf
