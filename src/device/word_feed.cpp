#include "device/word_feed.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/batch_check.h"
#include "core/little_endian.h"
#include "core/text.h"
#include "device/on_device.h"

namespace scarf {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

namespace {

constexpr uint32_t kTimeHigh = 0x8;  // type of a word, in both formats

// Microseconds between two wraps of the clock.
uint64_t loop_of(CameraWords words) {
  return uint64_t{1} << (words == CameraWords::evt2 ? 34 : 24);
}

// Unsigned: the distance of two times may not fit a signed difference.
bool beyond_reach(int64_t t, int64_t t_first) {
  const auto a = static_cast<uint64_t>(t);
  const auto b = static_cast<uint64_t>(t_first);
  return (t > t_first ? a - b : b - a) >= kMaxTimeDistance;
}

}  // namespace

WordFeed::WordFeed(std::shared_ptr<Stream> stream, CameraWords words)
    : stream_(std::move(stream)), words_(words), word_bytes_(WordDecoder::word_bytes(words)) {}

Result<std::unique_ptr<GpuDecoder>> WordFeed::create(std::shared_ptr<Stream> stream, CameraWords words) {
  std::unique_ptr<WordFeed> feed(
      new WordFeed(stream, words));  // outlives the lock, which its destructor takes
  return stream->exclusively([&]() -> Result<std::unique_ptr<GpuDecoder>> {
    if (stream->words_ != nullptr) {
      return Error{ErrorCode::illegal_parameter,
                   "the representation has a decoder already; destroy that one first"};
    }
    if (auto r = feed->start(); !r) return r.error();
    stream->words_ = feed.get();
    return std::unique_ptr<GpuDecoder>(std::move(feed));
  });
}

Result<void> WordFeed::start() {
  // As many words as events in a submission: cameras send about one word per event, or fewer.
  most_events_ = stream_->pipeline_->submission_events();
  capacity_bytes_ = most_events_ * word_bytes_;
  // A slot may begin with a word, or the beginning of one, that was left over.
  PipelineBuilder builder(stream_->device_);
  decoder_.build(builder, words_, stream_->sensor(), most_events_ + 2, most_events_);
  slots_ = std::vector<Slot>(stream_->options_.staging_slots);
  // Once words are taken nothing may fail for these.
  submitted_.reserve(slots_.size());
  rest_.reserve(word_bytes_);
  for (Slot& slot : slots_) decoder_.make_piece(builder, slot.piece);
  if (!builder.result()) return builder.result();
  bytes_ = builder.bytes();
  auto binding = stream_->pipeline_->bind_events(decoder_.events());
  if (!binding) return binding.error();
  binding_ = std::move(*binding);
  return {};
}

// Words that were pushed are not lost: if they cannot be settled, the stream says so.
WordFeed::~WordFeed() {
  if (stream_->device_.forked()) return;
  std::lock_guard lock(stream_->mutex_);
  if (stream_->words_ != this) return;
  if (stream_->usable() && holds_words()) {
    if (auto r = as_result([&] { return settle_all(); }); !r) stream_->fail(r.error());
  }
  stream_->words_ = nullptr;
  // Nothing may be destroyed while the device uses it.
  if (!stream_->device_.compute().wait(stream_->last_submission_) ||
      !stream_->device_.transfer().wait(stream_->last_transfer_)) {
    stream_->device_.calls().DeviceWaitIdle(stream_->device_.handle());
  }
  binding_.reset();  // under the lock: it is the pipeline's
}

Result<size_t> WordFeed::push(std::span<const uint8_t> bytes) {
  return stream_->exclusively([&]() -> Result<size_t> {
    if (auto r = stream_->ready_to_push(); !r) return r.error();
    if (auto r = usable(); !r) return r.error();
    if (auto r = stream_->submit_open(); !r) return r.error();
    size_t taken = 0;
    const auto pushed = as_result([&] { return take(bytes, taken); });
    if (pushed) return taken;
    const ErrorCode code = pushed.error().code;
    if (code == ErrorCode::would_block && taken > 0) return taken;
    if (code == ErrorCode::would_block || code == ErrorCode::refused_batch) return pushed.error();
    lost_ = true;
    return stream_->fail(pushed.error());
  });
}

Result<void> WordFeed::usable() const {
  if (!lost_) return {};
  return Error{ErrorCode::illegal_parameter,
               "a push of words failed, and how many of them were decoded is not known; make a new decoder"};
}

// Takes bytes from the front. `taken` tells how many, also after would_block.
Result<void> WordFeed::take(std::span<const uint8_t> bytes, size_t& taken) {
  taken = begin(bytes);
  while (taken < bytes.size() || (!is_open_ && rest_.size() >= word_bytes_)) {
    const auto batch = bytes.subspan(taken, std::min<size_t>(bytes.size() - taken, capacity_bytes_));
    const auto pushed = push_batch(batch);
    if (!pushed) return pushed.error();
    taken += *pushed;
    if (*pushed < batch.size()) break;
  }
  return {};
}

// Words before the first TIME_HIGH mean nothing. Returns how many bytes were taken; that word stays in rest_.
size_t WordFeed::begin(std::span<const uint8_t> bytes) {
  size_t taken = 0;
  while (!started_ && taken < bytes.size()) {
    rest_.push_back(bytes[taken++]);
    if (rest_.size() < word_bytes_) continue;
    started_ = rest_.back() >> 4 == kTimeHigh;  // little-endian: the type is in the last byte
    if (!started_) rest_.clear();
    // The device takes the first TIME_HIGH for a step from 0.
    gap_at_begin_ =
        started_ && words_ == CameraWords::evt3 && (load_little_endian<uint16_t>(rest_.data()) & 0xFFF) > 1;
  }
  return taken;
}

// Gathers bytes, at most as many as a slot holds. Where their events might be refused they get a slot of
// their own, which is settled at once.
Result<size_t> WordFeed::push_batch(std::span<const uint8_t> bytes) {
  const uint64_t wraps = most_wraps_in(bytes);
  const bool alone = may_be_refused(wraps);
  if (alone) {
    if (auto r = settle_all(); !r) return r.error();
  }
  size_t taken = 0;
  do {
    if (auto r = open_slot(stream_->options_.when_full); !r) {
      if (r.error().code == ErrorCode::would_block && taken > 0) break;
      return r.error();
    }
    const size_t room = alone ? bytes.size() : capacity_bytes_ - std::min<size_t>(fill_, capacity_bytes_);
    const auto some = bytes.subspan(taken, std::min(bytes.size() - taken, room));
    if (!some.empty())
      std::memcpy(open().piece.words.host.mapped_as<uint8_t>() + fill_, some.data(), some.size());
    fill_ += some.size();
    taken += some.size();
    most_wraps_ahead_ += wraps;  // in whichever of the slots they are
    if (fill_ >= capacity_bytes_) {
      if (auto r = submit_open(); !r) return r.error();
    }
  } while (taken < bytes.size());
  if (alone) {
    if (auto r = settle_all(); !r) return r.error();
  }
  return taken;
}

// Each wrap needs a TIME_HIGH in the upper half of its range, and one in the lower half behind it. An EVT2
// clock wraps after 4.8 hours, and 16,384 wraps are too much for a stream: so these words are counted. Of
// EVT3 wraps a thousand times as many are needed, which words of one stream in flight do not hold.
uint64_t WordFeed::most_wraps_in(std::span<const uint8_t> bytes) const {
  const uint64_t words = bytes.size() / word_bytes_ + 2;
  if (words_ == CameraWords::evt3) return words / 2 + 1;
  // The bytes may begin within a word: then up to two words at the ends are not seen.
  const size_t offset = (word_bytes_ - gathered() % word_bytes_) % word_bytes_;
  uint32_t upper = 0;
  uint32_t lower = 0;
  for (size_t at = offset; at + 4 <= bytes.size(); at += 4) {
    const uint32_t type = load_little_endian<uint32_t>(bytes.data() + at) >> 27;
    upper += type == (kTimeHigh << 1 | 1) ? 1 : 0;
    lower += type == kTimeHigh << 1 ? 1 : 0;
  }
  return std::min(upper, lower) + 3;
}

// No time of the stream is below 0, and none beyond the turn of the clock behind all wraps that there may be.
bool WordFeed::may_be_refused(uint64_t more_wraps) const {
  uint64_t wraps = wraps_ + most_wraps_ahead_ + more_wraps;
  for (const size_t i : submitted_) wraps += slots_[i].most_wraps;
  const uint64_t most_wraps = kMaxTimeDistance / loop_of(words_);
  if (wraps + 1 >= most_wraps) return true;
  const auto end = static_cast<int64_t>((wraps + 1) * loop_of(words_));
  const auto first = stream_->facts_.first;
  return first && (beyond_reach(0, *first) || beyond_reach(end, *first));
}

// The slot that gathers words, with room for some.
Result<void> WordFeed::open_slot(GpuOptions::WhenFull when_full) {
  if (is_open_) return {};
  const size_t next = (open_ + 1) % slots_.size();
  const auto ready = [&](uint64_t value) -> Result<void> {
    if (when_full == GpuOptions::WhenFull::wait) return stream_->device_.compute().wait(value);
    const auto done = stream_->device_.compute().done(value);
    if (!done) return done.error();
    if (*done) return {};
    return Error{ErrorCode::would_block,
                 "every staging slot is in flight; push again later, or choose to wait"};
  };
  // All but the newest piece, and that one too if its slot is the next one.
  const size_t keep = slots_.size() == 1 ? 0 : 1;
  while (submitted_.size() > keep) {
    if (auto r = ready(slots_[submitted_.front()].counted); !r) return r;
    if (auto r = settle_oldest(); !r) return r;
  }
  if (auto r = ready(slots_[next].last_use); !r) return r;
  open_ = next;
  is_open_ = true;
  fill_ = rest_.size();
  std::copy(rest_.begin(), rest_.end(), open().piece.words.host.mapped_as<uint8_t>());
  rest_.clear();
  return {};
}

// Submits the words gathered, if there are any. If that fails they stay where they are.
Result<void> WordFeed::submit_open() {
  if (!is_open_ || fill_ < word_bytes_) return {};
  Slot& slot = open();
  const auto words = static_cast<uint32_t>(fill_ / word_bytes_);
  auto commands = stream_->take_commands();
  if (!commands) return commands.error();
  auto submitted = as_result([&]() -> Result<void> {
    const auto copy = [&](Commands& c) {
      c.copy(slot.piece.words.host, 0, slot.piece.words.device, 0, uint64_t{words} * word_bytes_);
    };
    if (auto r = stream_->begin_with_upload(**commands, copy); !r) return r;
    if (!clear_) decoder_.record_reset((*commands)->compute);
    decoder_.record_count((*commands)->compute, slot.piece, words);
    return stream_->submit(**commands);
  });
  // Also after a failure: the transfer may be in flight.
  stream_->push_pool_.give_back(std::move(*commands));
  if (!submitted) return submitted;
  clear_ = true;
  slot.words = words;
  slot.read = false;
  slot.counted = slot.last_use = stream_->last_submission_;
  slot.most_wraps = std::exchange(most_wraps_ahead_, 0);
  submitted_.push_back(open_);
  const auto* const bytes = slot.piece.words.host.mapped_as<uint8_t>();
  rest_.assign(bytes + uint64_t{words} * word_bytes_, bytes + fill_);
  is_open_ = false;
  return {};
}

Result<void> WordFeed::settle_all() {
  if (!is_open_ && rest_.size() >= word_bytes_) {
    if (auto r = open_slot(GpuOptions::WhenFull::wait); !r) return r;
  }
  if (auto r = submit_open(); !r) return r;
  while (!submitted_.empty()) {
    if (auto r = settle_oldest(); !r) return r;
  }
  return {};
}

Result<void> WordFeed::discard_all() {
  if (auto r = submit_open(); !r) return r;
  for (; !submitted_.empty(); settled()) {
    Slot& slot = slots_[submitted_.front()];
    if (auto r = read_result(slot); !r) return r;
  }
  return {};
}

Result<void> WordFeed::settle_oldest() {
  Slot& slot = slots_[submitted_.front()];
  if (auto r = read_result(slot); !r) return r;
  if (auto r = submit_events(slot); !r) {
    if (r.error().code == ErrorCode::refused_batch) settled();
    return r;
  }
  settled();
  return {};
}

// Waits for the facts of a piece and adds them to the report, once.
Result<void> WordFeed::read_result(Slot& slot) {
  if (slot.read) return {};
  if (auto r = stream_->device_.compute().wait(slot.counted); !r) return r;
  const layout::DecodeResult& result = slot.piece.read_result();
  const layout::DecodeFacts& facts = result.facts;
  report_.events += facts.inside;
  report_.outside += facts.outside;
  report_.unknown_words += facts.unknown;
  report_.gaps += facts.gaps;
  report_.back_steps += facts.back_steps;
  report_.largest_back_step = std::max(report_.largest_back_step, facts.largest_step);
  static_assert(layout::kDecodeLongestStep == kLongestStep);
  const auto note_jump = [this](int64_t step, int64_t from) {
    if (step <= report_.largest_jump) return;
    report_.largest_jump = step;
    report_.largest_jump_from = from;
  };
  report_.jumps += facts.jumps;
  if (facts.first >= 0) {
    if (last_time_ >= 0 && facts.first - last_time_ > kLongestStep) {
      ++report_.jumps;
      note_jump(facts.first - last_time_, last_time_);
    }
    note_jump(facts.largest_jump, facts.largest_jump_from);
    if (facts.first < last_time_) {
      ++report_.back_steps;
      report_.largest_back_step = std::max(report_.largest_back_step, last_time_ - facts.first);
    }
    last_time_ = facts.last;
  }
  wraps_ = result.loops_low | uint64_t{result.loops_high} << 32;
  slot.most_wraps = 0;
  slot.events = facts.inside;
  slot.next_event = 0;
  slot.read = true;
  return {};
}

// The rest of a piece's events joins the state, as many at a time as the pipeline takes.
Result<void> WordFeed::submit_events(Slot& slot) {
  const layout::DecodeFacts& found = slot.piece.read_result().facts;
  if (slot.events == 0) return {};
  if (slot.next_event == 0) {
    StreamFacts facts = stream_->facts_;
    if (!facts.first) facts.first = found.first_inside;
    if (beyond_reach(found.smallest, *facts.first) || beyond_reach(found.largest, *facts.first)) {
      const auto events = events_of(slot);
      if (!events) return events.error();
      const auto checked = check_batch(*events, stream_->sensor(), stream_->facts_.first);
      if (!checked) return checked.error();
    }
    facts.newest = found.last_inside;
    facts.largest = std::max(facts.largest.value_or(found.largest), found.largest);
    stream_->facts_ = facts;
  }
  while (slot.next_event < slot.events) {
    const uint32_t count = std::min(slot.events - slot.next_event, most_events_);
    if (auto r = stream_->pipeline_->prepare_push(count); !r) return r;
    auto commands = stream_->take_commands();
    if (!commands) return commands.error();
    Commands& c = (*commands)->compute;
    auto submitted = as_result([&]() -> Result<void> {
      if (auto r = (*commands)->begin(); !r) return r;
      decoder_.record_write(c, slot.piece, slot.words, slot.next_event, count);
      stream_->pipeline_->record_push(c, *binding_, 0, count, stream_->facts_);
      return stream_->submit(**commands);
    });
    stream_->push_pool_.give_back(std::move(*commands));
    if (!submitted) {
      stream_->pipeline_->recording_lost();
      return submitted;
    }
    slot.last_use = stream_->last_submission_;
    slot.next_event += count;
  }
  return {};
}

// All events of a piece, for the message about one of them.
Result<std::vector<Event>> WordFeed::events_of(const Slot& slot) {
  auto copy = Buffer::create(stream_->device_, "the events for the host",
                             uint64_t{most_events_} * sizeof(Event), MemoryUse::readback);
  if (!copy) return copy.error();
  std::vector<Event> events(slot.events);
  for (uint32_t first = 0; first < slot.events; first += most_events_) {
    const uint32_t count = std::min(slot.events - first, most_events_);
    const auto copied = run_alone(stream_->device_, [&](Commands& c) {
      decoder_.record_write(c, slot.piece, slot.words, first, count);
      c.copy(decoder_.events(), 0, *copy, 0, uint64_t{count} * sizeof(Event));
    });
    if (!copied) return copied.error();
    std::memcpy(events.data() + first, copy->mapped(), uint64_t{count} * sizeof(Event));
  }
  return events;
}

Result<ReadReport> WordFeed::report() {
  return stream_->exclusively([&]() -> Result<ReadReport> {
    if (auto r = stream_->usable(); !r) return r.error();
    if (auto r = usable(); !r) return r.error();
    if (auto r = settle_all(); !r) return r.error();
    ReadReport report = report_;
    report.truncated_bytes = gathered();
    report.gaps -= gap_at_begin_ ? 1 : 0;
    return report;
  });
}

Result<std::optional<int64_t>> WordFeed::newest() {
  return stream_->exclusively([&]() -> Result<std::optional<int64_t>> {
    if (auto r = stream_->usable(); !r) return r.error();
    if (auto r = stream_->submit_gathered(); !r) return r.error();
    return stream_->facts_.newest;
  });
}

Result<std::unique_ptr<GpuDecoder>> make_gpu_decoder(GpuRepresentation& representation, CameraWords words) {
  return as_result([&]() -> Result<std::unique_ptr<GpuDecoder>> {
    auto* const fed = dynamic_cast<StreamFed*>(&representation);
    if (fed == nullptr) {
      return Error{
          ErrorCode::illegal_parameter,
          "only representations that scarf made on a device take words; decode them with open_events"};
    }
    return WordFeed::create(fed->stream(), words);
  });
}

}  // namespace scarf
