#include "device/stream.h"

#include <algorithm>
#include <cstring>

#include "core/batch_check.h"
#include "core/text.h"
#include "device/word_feed.h"
#include "kernels/submission.h"

namespace scarf {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

namespace {

StreamFacts with(StreamFacts facts, const CheckedBatch& batch) {
  facts.first = batch.t_first;
  facts.outside += batch.outside;
  if (batch.t_newest) facts.newest = batch.t_newest;
  if (batch.t_largest) facts.largest = std::max(facts.largest.value_or(*batch.t_largest), *batch.t_largest);
  return facts;
}

Error because(const char* sentence, const Error& e) noexcept {
  try {
    return {e.code, text(sentence, e.message)};
  } catch (const std::bad_alloc&) {
    return copy_of(e);
  }
}

}  // namespace

Result<std::unique_ptr<Query>> Query::create(vulkan::Device& device) {
  auto commands = Commands::create(device, device.compute());
  if (!commands) return commands.error();
  auto query = std::make_unique<Query>();
  query->commands = std::move(*commands);
  return query;
}

uint64_t Query::memory_bytes() const {
  uint64_t bytes = memory ? memory->memory_bytes() : 0;
  for (const Buffer& b : results) bytes += b.size();
  return bytes;
}

Result<void> Query::copy_back(vulkan::Device& device, std::span<const Part> parts, size_t first) {
  if (results.size() < first + parts.size()) results.resize(first + parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    Buffer& result = results[first + i];
    if (result.size() < parts[i].bytes) {
      auto buffer = Buffer::create(device, "the result for the host", parts[i].bytes, MemoryUse::readback);
      if (!buffer) return buffer.error();
      result = std::move(*buffer);
    }
    commands.copy(*parts[i].buffer, 0, result, 0, parts[i].bytes);
  }
  if (!parts.empty()) commands.mark("copy");
  return {};
}

Result<std::shared_ptr<Stream>> Stream::create(std::shared_ptr<GpuContext> context,
                                               std::unique_ptr<Pipeline> pipeline,
                                               const GpuOptions& options) {
  if (auto r = check_options(options); !r) return r.error();
  std::shared_ptr<Stream> stream(new Stream(std::move(context), std::move(pipeline), options));
  if (auto r = stream->start(); !r) return r.error();
  return stream;
}

Stream::Stream(std::shared_ptr<GpuContext> context, std::unique_ptr<Pipeline> pipeline,
               const GpuOptions& options)
    : context_(std::move(context)),
      device_(context_->vulkan()),
      options_(options),
      pipeline_(std::move(pipeline)) {}

Stream::~Stream() {
  if (device_.forked()) return;
  // Nothing may be destroyed while the device uses it. A lost device uses nothing; after any other failure
  // to wait, waiting for everything is tried.
  const bool idle =
      device_.compute().wait(last_submission_).ok() && device_.transfer().wait(last_transfer_).ok();
  if (!idle) device_.calls().DeviceWaitIdle(device_.handle());
}

Result<void> Stream::start() {
  for (uint32_t i = 0; i < options_.staging_slots; ++i) {
    auto slot = make_slot();
    if (!slot) return slot.error();
    staging_.push_back(std::move(*slot));
  }
  return reset();
}

Result<PushReport> Stream::push(std::span<const Event> events) {
  return exclusively([&]() -> Result<PushReport> {
    if (auto r = ready_to_push(); !r) return r.error();
    if (words_ != nullptr) {
      if (auto r = words_->settle_all(); !r) return r.error();
    }
    auto batch = check_batch(events, sensor(), facts_.first);
    if (!batch) return batch.error();
    const StreamFacts before = facts_;
    facts_ = with(before, *batch);
    size_t accepted = 0;
    const auto stored = as_result([&] { return store(events, accepted); });
    if (stored) return PushReport{accepted, batch->outside};
    if (accepted == 0) {  // nothing has happened
      facts_ = before;
      return stored.error();
    }
    if (stored.error().code != ErrorCode::would_block) return fail(stored.error());
    // A batch that was taken in part counts as that part.
    batch = check_batch(events.first(accepted), sensor(), before.first);
    facts_ = with(before, *batch);
    return PushReport{accepted, batch->outside};
  });
}

// Appends checked events, and submits where a slot is full. `stored` tells how many, also after an error.
Result<void> Stream::store(std::span<const Event> events, size_t& stored) {
  while (stored < events.size()) {
    const auto slot = open_slot(1);
    if (!slot) return slot.error();
    StagingSlot& s = **slot;
    const size_t n = std::min<size_t>(events.size() - stored, room(s));
    append(s, events.subspan(stored, n));
    stored += n;
    if (room(s) == 0) {
      if (auto r = submit_open(); !r) return r;
    }
  }
  return {};
}

Result<std::span<Event>> Stream::acquire(size_t n) {
  return exclusively([&]() -> Result<std::span<Event>> {
    if (auto r = ready_to_push(); !r) return r.error();
    if (n > max_acquire()) {
      return Error{ErrorCode::illegal_parameter,
                   text("acquire of ", n, " events, legal is 0 to ", max_acquire())};
    }
    if (words_ != nullptr) {
      if (auto r = words_->settle_all(); !r) return r.error();
    }
    const auto slot = open_slot(std::max<size_t>(n, 1));
    if (!slot) return slot.error();
    const std::span<Event> events(lend(**slot, n), n);
    acquired_ = n;
    return events;
  });
}

Result<PushReport> Stream::commit(size_t count) {
  return exclusively([&]() -> Result<PushReport> {
    if (auto r = usable(); !r) return r.error();
    if (!acquired_ || count > *acquired_) {
      return Error{ErrorCode::illegal_parameter,
                   text("commit of ", count, " events, but acquired were ", acquired_.value_or(0))};
    }
    acquired_.reset();
    StagingSlot& s = staging_[open_];
    const std::span<const Event> events(lend(s, 0), count);
    const auto batch = check_batch(events, sensor(), facts_.first);
    if (!batch) return batch.error();
    facts_ = with(facts_, *batch);
    append(s, events);
    if (room(s) == 0) {
      if (auto r = as_result([&] { return submit_open(); }); !r) return fail(r.error());
    }
    return PushReport{count, batch->outside};
  });
}

Result<void> Stream::flush() {
  return exclusively([&]() -> Result<void> {
    if (auto r = usable(); !r) return r;
    return submit_gathered();
  });
}

Result<void> Stream::finish() {
  uint64_t last = 0;
  auto submitted = exclusively([&]() -> Result<void> {
    if (auto r = usable(); !r) return r;
    if (auto r = submit_gathered(); !r) return r;
    last = last_submission_;
    return {};
  });
  return submitted ? device_.compute().wait(last) : submitted;
}

Result<void> Stream::reset() {
  return exclusively([&]() -> Result<void> {
    if (words_ != nullptr) {
      if (auto r = words_->discard_all(); !r) return r;
    }
    auto commands = take_commands();
    if (!commands) return commands.error();
    if (auto r = (*commands)->begin(); !r) return r;
    auto submitted = as_result([&] {
      pipeline_->record_reset((*commands)->compute);
      return submit(**commands);
    });
    if (!submitted) {
      failure_ = because("the stream is not empty since a reset failed: ", submitted.error());
      return submitted;
    }
    push_pool_.give_back(std::move(*commands));
    // Events gathered so far belong to the old stream.
    StagingSlot& open = staging_[open_];
    open.begin = open.fill;
    if (packed()) open.packer.end_part();
    facts_ = {};
    failure_.reset();
    return {};
  });
}

std::vector<StageTime> Stream::stage_times() {
  if (device_.forked()) return {};
  std::lock_guard lock(mutex_);
  stage_times_.collect_idle(push_pool_);
  for (const auto& pool : query_pools_) stage_times_.collect_idle(pool);
  return stage_times_.all();
}

uint64_t Stream::memory_bytes() {
  if (device_.forked()) return 0;
  std::lock_guard lock(mutex_);
  uint64_t bytes = pipeline_->memory_bytes() + query_bytes_ + unpacker_.memory_bytes();
  for (const StagingSlot& s : staging_) bytes += s.memory.memory_bytes();
  if (words_ != nullptr) bytes += words_->memory_bytes();
  return bytes;
}

// After a failed push, part of a batch may be stored: the stream then refuses everything until reset().
Error Stream::fail(const Error& e) noexcept {
  failure_ = because("the stream is incomplete since a push failed: ", e);
  return copy_of(e);
}

Result<void> Stream::usable() const noexcept {
  return failure_ ? Result<void>(copy_of(*failure_)) : Result<void>();
}

Result<void> Stream::ready_to_push() const {
  if (!acquired_) return usable();
  return Error{ErrorCode::illegal_parameter,
               "staging memory is acquired: commit it before the next push or acquire"};
}

Result<Stream::StagingSlot> Stream::make_slot() {
  StagingSlot s;
  // How large it is depends on where it is, which a small buffer tells.
  if (staging_.empty()) {
    const auto probe = Buffer::create(device_, "the staging memory", 1, MemoryUse::upload);
    if (!probe) return probe.error();
    upload_ = upload_path(device_, *probe);
  }
  const auto most_events = static_cast<uint32_t>(max_acquire());
  const uint64_t bytes =
      packed() ? EventPacker::memory_words(most_events) * sizeof(uint32_t) : most_events * sizeof(Event);
  auto memory = StagedBuffer::create(device_, "the staging memory", "the event memory", bytes);
  if (!memory) return memory.error();
  s.memory = std::move(*memory);
  if (!packed()) {
    auto binding = pipeline_->bind_events(s.memory.for_shaders());
    if (!binding) return binding.error();
    s.binding = std::move(*binding);
    return s;
  }
  s.packer = EventPacker(sensor(), s.memory.host.mapped_as<uint32_t>(), most_events);
  PipelineBuilder builder(device_);
  if (staging_.empty()) unpacker_.build(builder, most_events);
  unpacker_.bind(builder, s.unpack, s.memory.for_shaders());
  if (!builder.result()) return builder.result().error();
  if (staging_.empty()) {
    auto binding = pipeline_->bind_events(unpacker_.events());
    if (!binding) return binding.error();
    unpacked_binding_ = std::move(*binding);
  }
  return s;
}

// At most room(s) events.
void Stream::append(StagingSlot& s, std::span<const Event> events) {
  Event* const place = s.memory.host.mapped_as<Event>() + s.fill;
  if (packed())
    s.packer.append(events);
  else if (events.data() != place)  // events of acquire are there already
    std::memcpy(place, events.data(), events.size_bytes());
  s.fill += static_cast<uint32_t>(events.size());
}

// Memory for n events behind those gathered; with fewer it is the same again.
Event* Stream::lend(StagingSlot& s, size_t n) {
  if (!packed()) return s.memory.host.mapped_as<Event>() + s.fill;
  if (lent_.size() < n) lent_.resize(n);
  return lent_.data();
}

void Stream::empty(StagingSlot& s) {
  s.begin = s.fill = 0;
  if (packed()) s.packer.restart();
}

// The slot that gathers events, with room for n.
Result<Stream::StagingSlot*> Stream::open_slot(size_t n) {
  if (room(staging_[open_]) < n) {
    if (auto r = submit_open(); !r) return r.error();
    const size_t next = room(staging_[open_]) < n ? (open_ + 1) % staging_.size() : open_;
    StagingSlot& s = staging_[next];
    const auto done = device_.compute().done(s.last_use);
    if (!done) return done.error();
    if (!*done && options_.when_full == GpuOptions::WhenFull::would_block) {
      return Error{ErrorCode::would_block,
                   "every staging slot is in flight; push again later, or choose to wait"};
    }
    if (auto r = device_.compute().wait(s.last_use); !r) return r.error();
    open_ = next;
    empty(s);
  }
  return &staging_[open_];
}

Result<void> Stream::submit_gathered() {
  return words_ != nullptr && words_->holds_words() ? words_->settle_all() : submit_open();
}

// For submitters of several streams: as prepare_open(). Words are submitted here.
Result<bool> Stream::prepare_gathered() {
  if (auto r = usable(); !r) return r.error();
  if (words_ == nullptr || !words_->holds_words()) return prepare_open();
  if (auto r = words_->settle_all(); !r) return r.error();
  return false;
}

// Submits the gathered events, if there are any. If that fails they stay where they are.
Result<void> Stream::submit_open() {
  const auto any = prepare_open();
  if (!any) return any.error();
  if (!*any) return {};
  auto commands = take_commands();
  if (!commands) return commands.error();
  auto submitted = as_result([&]() -> Result<void> {
    if (auto r = begin_with_upload(**commands, [this](Commands& c) { record_copies(c); }); !r) return r;
    record_open((*commands)->compute);
    return submit(**commands);
  });
  // Also after a failure: the transfer may be in flight.
  push_pool_.give_back(std::move(*commands));
  if (submitted)
    open_is_submitted();
  else
    pipeline_->recording_lost();
  return submitted;
}

Result<bool> Stream::prepare_open() {
  StagingSlot& s = staging_[open_];
  if (s.begin == s.fill) return false;
  if (auto r = pipeline_->prepare_push(s.fill - s.begin); !r) return r.error();
  if (packed()) s.part = s.packer.part();
  return true;
}

void Stream::record_copies(Commands& commands) const {
  const StagingSlot& s = staging_[open_];
  const auto copy = [&](size_t begin, size_t words) {
    const uint64_t offset = begin * sizeof(uint32_t);
    commands.copy(s.memory.host, offset, s.memory.device, offset, words * sizeof(uint32_t));
  };
  copy(s.part.table_begin, s.part.table_words);
  copy(s.part.data_begin, s.part.data_words);
}

void Stream::record_open(Commands& commands) {
  StagingSlot& s = staging_[open_];
  const uint32_t count = s.fill - s.begin;
  if (!packed()) {
    pipeline_->record_push(commands, *s.binding, s.begin, count, facts_);
    return;
  }
  unpacker_.record(commands, s.unpack, s.part.push);
  pipeline_->record_push(commands, *unpacked_binding_, 0, count, facts_);
}

void Stream::open_is_submitted() {
  StagingSlot& s = staging_[open_];
  s.last_use = last_submission_;
  s.begin = s.fill;
  if (packed()) s.packer.end_part();
  if (!acquired_) advance();
}

Result<void> Stream::begin_with_upload(PushCommands& commands, const std::function<void(Commands&)>& copy) {
  auto begun = as_result([&] { return commands.begin(upload_, copy); });
  if (commands.transferred != 0) last_transfer_ = commands.transferred;
  return begun;
}

Result<void> Stream::submit(PushCommands& commands) {
  if (auto r = commands.submit(device_); !r) return r;
  last_submission_ = commands.compute.value();
  return {};
}

Result<void> Stream::submit(Query& query) {
  if (auto r = query.commands.submit(); !r) return r;
  last_submission_ = query.commands.value();
  return {};
}

// Moves on to the next slot if that is free, so that the next batch does not have to fit into what is left
// of this one.
void Stream::advance() {
  const size_t next = (open_ + 1) % staging_.size();
  const auto done = device_.compute().done(staging_[next].last_use);
  if (!done || !*done) return;
  open_ = next;
  empty(staging_[next]);
}

Result<std::unique_ptr<PushCommands>> Stream::take_commands() {
  auto commands = push_pool_.take([this] { return PushCommands::create(device_, upload_); });
  if (commands) stage_times_.collect((*commands)->compute);
  return commands;
}

Result<std::unique_ptr<Query>> Stream::take_query(QueryKind kind) {
  auto query = query_pools_[static_cast<size_t>(kind)].take([this] { return Query::create(device_); });
  if (query) stage_times_.collect((*query)->commands);
  return query;
}

template <class T>
Pending<T> Stream::ask(QueryKind kind, const Record<T>& record, bool changes_state) {
  // The query in flight; it goes back to its pool when the Pending result is gone.
  struct Lease {
    std::shared_ptr<Stream> stream;
    QueryKind kind;
    std::unique_ptr<Query> query;
    size_t parts = 0;  // of the answer; an earlier query may have left more results
    std::function<Result<T>(HostParts)> read;

    Lease(std::shared_ptr<Stream> of, QueryKind of_kind) : stream(std::move(of)), kind(of_kind) {}
    ~Lease() {
      if (!query || stream->device_.forked()) return;
      std::lock_guard lock(stream->mutex_);
      stream->query_pools_[static_cast<size_t>(kind)].give_back(std::move(query));
    }
    Result<T> wait() const {
      if (auto r = stream->device_.check_process(); !r) return r.error();
      if (auto r = query->commands.wait(); !r) return r.error();
      std::vector<const void*> results;
      for (size_t i = 0; i < parts; ++i) results.push_back(query->results[i].mapped());
      return read(results);
    }
  };

  return as_result([&]() -> Pending<T> {
    const auto lease = std::make_shared<Lease>(shared_from_this(), kind);  // outlives the lock, which its
    return exclusively([&]() -> Pending<T> {                               // destructor takes
      if (auto r = usable(); !r) return r.error();
      if (auto r = submit_gathered(); !r) return r.error();
      auto taken = take_query(kind);
      if (!taken) return taken.error();
      lease->query = std::move(*taken);
      Query& q = *lease->query;
      const uint64_t bytes_before = q.memory_bytes();
      // Made first: behind the submission nothing may fail.
      Pending<T> pending(
          [lease] {
            if (lease->stream->device_.forked()) return true;
            const auto done = lease->query->commands.done();
            return !done || *done;
          },
          [lease] { return lease->wait(); });
      const auto submitted = as_result([&]() -> Result<void> {
        if (auto r = q.commands.begin(); !r) return r;
        auto answer = record(q, facts_);
        if (!answer) return answer.error();
        if (auto r = q.copy_back(device_, answer->parts); !r) return r;
        lease->parts = answer->parts.size();
        lease->read = std::move(answer->read);
        auto r = as_result([&] { return submit(q); });
        return !r && changes_state ? Result<void>(fail(r.error())) : r;
      });
      query_bytes_ += q.memory_bytes() - bytes_before;
      if (!submitted) return submitted.error();
      return pending;
    });
  });
}

template Pending<Image<uint8_t>> Stream::ask(QueryKind, const Record<Image<uint8_t>>&, bool);
template Pending<Image<float>> Stream::ask(QueryKind, const Record<Image<float>>&, bool);
template Pending<Image<int32_t>> Stream::ask(QueryKind, const Record<Image<int32_t>>&, bool);
template Pending<Image<int64_t>> Stream::ask(QueryKind, const Record<Image<int64_t>>&, bool);
template Pending<std::vector<Event>> Stream::ask(QueryKind, const Record<std::vector<Event>>&, bool);
template Pending<std::vector<uint8_t>> Stream::ask(QueryKind, const Record<std::vector<uint8_t>>&, bool);
template Pending<Snapshot> Stream::ask(QueryKind, const Record<Snapshot>&, bool);
template Pending<std::vector<FilterReport>> Stream::ask(QueryKind, const Record<std::vector<FilterReport>>&,
                                                        bool);

}  // namespace scarf
