// SCARF on a device behind the public interface: staging of batches, queries in flight, threads and failures.
#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

#include "core/batch_check.h"
#include "core/packed_event.h"
#include "core/queries.h"
#include "core/text.h"
#include "scarf/gpu.h"
#include "scarf/pipeline.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;
using Upload = DeviceOptions::Upload;

// Staging memory. Events begin .. fill-1 are pushed but not yet submitted, those before are in flight or
// done.
struct StagingSlot {
  Buffer host;
  Buffer device;  // copy of `host`, where shaders do not read host memory
  PushKernels kernels;
  uint32_t begin = 0;
  uint32_t fill = 0;
  uint64_t last_use = 0;  // place in the compute timeline
};

struct PushCommands {
  Commands compute;
  Commands transfer;  // only with Upload::transfer_queue
};

// What a query needs while it is in flight; used again afterwards.
struct ImageQuery {
  Commands commands;
  Buffer result;
};
struct EventQuery {
  Commands commands;
  std::unique_ptr<ExtractTarget> target;
};
struct SnapshotQuery {
  Commands commands;
  Buffer totals;
  Buffer slots;
};

Commands& compute_of(PushCommands& c) {
  return c.compute;
}
template <class Query>
Commands& compute_of(Query& q) {
  return q.commands;
}

// Objects that are either idle (perhaps still in flight on the device) or lent out.
template <class T>
class Pool {
 public:
  using Make = std::function<Result<std::unique_ptr<T>>()>;

  // An object whose last submission is done; a new one if there is none and at most `limit` exist.
  Result<std::unique_ptr<T>> take(size_t limit, const Make& make) {
    for (size_t i = 0; i < idle_.size(); ++i) {
      const auto done = compute_of(*idle_[i]).done();
      if (!done) return done.error();
      if (*done) return take_at(i);
    }
    if (idle_.size() < limit) return make();
    if (auto r = compute_of(*idle_.front()).wait(); !r) return r.error();
    return take_at(0);
  }
  void give_back(std::unique_ptr<T> object) { idle_.push_back(std::move(object)); }
  std::vector<std::unique_ptr<T>>& idle() { return idle_; }

 private:
  std::unique_ptr<T> take_at(size_t i) {
    std::unique_ptr<T> object = std::move(idle_[i]);
    idle_.erase(idle_.begin() + static_cast<std::ptrdiff_t>(i));
    return object;
  }
  std::vector<std::unique_ptr<T>> idle_;
};

constexpr size_t kIdleLimit = 32;  // command buffers in flight before push waits for one

uint32_t planes_of(PolarityMode mode) {
  return mode == PolarityMode::separate ? 2 : 1;
}

// Everything of a stream. Pending results share it, so that they may outlive the GpuScarf.
class Stream : public std::enable_shared_from_this<Stream> {
 public:
  Stream(std::shared_ptr<GpuContext> context, const Geometry& geometry, const GpuOptions& options)
      : context_(std::move(context)), device_(context_->vulkan()), geometry_(geometry), options_(options) {}

  ~Stream() {
    // Nothing may be destroyed while the device uses it. A lost device uses nothing; after any other failure
    // to wait, waiting for everything is tried.
    const bool idle =
        device_.compute().wait(last_submission_).ok() && device_.transfer().wait(last_transfer_).ok();
    if (!idle) device_.calls().DeviceWaitIdle(device_.handle());
  }

  Result<void> start(const Levels& levels) {
    auto plan = make_plan(geometry_, device_.limits(), options_);
    if (!plan) return plan.error();
    auto pipeline = ScarfPipeline::create(device_, geometry_, levels, *plan);
    if (!pipeline) return pipeline.error();
    pipeline_ = std::move(*pipeline);
    for (uint32_t i = 0; i < options_.staging_slots; ++i) {
      auto slot = make_slot();
      if (!slot) return slot.error();
      staging_.push_back(std::move(*slot));
    }
    return reset();
  }

  const Geometry& geometry() const { return geometry_; }
  size_t max_acquire() const { return pipeline_->plan().submission_events; }

  Result<PushReport> push(std::span<const Event> events) {
    std::lock_guard lock(mutex_);
    if (auto r = ready_to_push(); !r) return r.error();
    auto batch = check_batch(events, geometry_.sensor(), t_first_);
    if (!batch) return batch.error();
    const std::optional<int64_t> t_first_before = t_first_;
    t_first_ = batch->t_first;
    size_t accepted = 0;
    while (accepted < events.size()) {
      const auto slot = open_slot(1);
      if (!slot && slot.error().code == ErrorCode::would_block) {
        // A batch that was taken in part counts as that part.
        batch = check_batch(events.first(accepted), geometry_.sensor(), t_first_before);
        t_first_ = batch->t_first;
        if (accepted == 0) return slot.error();
        break;
      }
      if (!slot) return fail(slot.error());
      StagingSlot& s = **slot;
      const size_t n = std::min<size_t>(events.size() - accepted, room(s));
      std::memcpy(s.host.mapped_as<Event>() + s.fill, events.data() + accepted, n * sizeof(Event));
      s.fill += static_cast<uint32_t>(n);
      accepted += n;
      if (room(s) == 0) {
        if (auto r = submit_open(); !r) return fail(r.error());
      }
    }
    return PushReport{accepted, batch->outside};
  }

  Result<std::span<Event>> acquire(size_t n) {
    std::lock_guard lock(mutex_);
    if (auto r = ready_to_push(); !r) return r.error();
    if (n > max_acquire()) {
      return Error{ErrorCode::illegal_parameter,
                   text("acquire of ", n, " events, legal is 0 to ", max_acquire())};
    }
    const auto slot = open_slot(std::max<size_t>(n, 1));
    if (!slot) return slot.error().code == ErrorCode::would_block ? slot.error() : fail(slot.error());
    acquired_ = n;
    return std::span((*slot)->host.mapped_as<Event>() + (*slot)->fill, n);
  }

  Result<PushReport> commit(size_t count) {
    std::lock_guard lock(mutex_);
    if (auto r = usable(); !r) return r.error();
    if (!acquired_ || count > *acquired_) {
      return Error{ErrorCode::illegal_parameter,
                   text("commit of ", count, " events, but acquired were ", acquired_.value_or(0))};
    }
    acquired_.reset();
    StagingSlot& s = staging_[open_];
    const std::span<const Event> events(s.host.mapped_as<Event>() + s.fill, count);
    const auto batch = check_batch(events, geometry_.sensor(), t_first_);
    if (!batch) return batch.error();
    t_first_ = batch->t_first;
    s.fill += static_cast<uint32_t>(count);
    if (room(s) == 0) {
      if (auto r = submit_open(); !r) return fail(r.error());
    }
    return PushReport{count, batch->outside};
  }

  Result<void> flush() {
    std::lock_guard lock(mutex_);
    if (auto r = usable(); !r) return r;
    return submit_open();
  }

  Result<void> finish() {
    std::unique_lock lock(mutex_);
    if (auto r = usable(); !r) return r;
    if (auto r = submit_open(); !r) return r;
    const uint64_t last = last_submission_;
    lock.unlock();
    return device_.compute().wait(last);
  }

  Result<void> reset() {
    std::lock_guard lock(mutex_);
    auto commands = take_commands();
    if (!commands) return commands.error();
    Commands& c = (*commands)->compute;
    if (auto r = c.begin(); !r) return r;
    pipeline_->record_reset(c);
    if (auto r = submit(c); !r) return r;
    push_pool_.give_back(std::move(*commands));
    // Events gathered so far belong to the old stream.
    StagingSlot& open = staging_[open_];
    open.begin = open.fill;
    t_first_.reset();
    failure_.reset();
    return {};
  }

  template <class T>
  Pending<Image<T>> image(PolarityMode mode) {
    std::lock_guard lock(mutex_);
    if (auto r = prepare_query(); !r) return r.error();
    auto query = image_pool_.take(kIdleLimit, [this] { return make_image_query(); });
    if (!query) return query.error();
    Commands& c = (*query)->commands;
    if (auto r = begin(c); !r) return r.error();
    const uint32_t planes = planes_of(mode);
    const uint64_t bytes = uint64_t{planes} * geometry_.x.size * geometry_.y.size * sizeof(T);
    const auto record = [&]() -> const Buffer& {
      if constexpr (std::is_same_v<T, uint8_t>)
        return pipeline_->record_u8(c, mode);
      else if constexpr (std::is_same_v<T, float>)
        return pipeline_->record_float(c, mode);
      else
        return pipeline_->record_counts(c, mode);
    };
    c.copy(record(), 0, (*query)->result, 0, bytes);
    c.mark("copy");
    if (auto r = submit(c); !r) return r.error();
    return pending<Image<T>>(image_pool_, std::move(*query), [g = geometry_, planes, bytes](ImageQuery& q) {
      Image<T> image(g.x.size, g.y.size, static_cast<int32_t>(planes));
      std::memcpy(image.pixels.data(), q.result.mapped(), bytes);
      return image;
    });
  }

  Pending<std::vector<Event>> events(int64_t first, int64_t count, bool active_only, EventOrder order) {
    std::lock_guard lock(mutex_);
    if (auto r = prepare_query(); !r) return r.error();
    auto query = event_pool_.take(kIdleLimit, [this] { return make_event_query(); });
    if (!query) return query.error();
    Commands& c = (*query)->commands;
    if (auto r = begin(c); !r) return r.error();
    pipeline_->record_extract(c, *(*query)->target, static_cast<uint32_t>(first),
                              static_cast<uint32_t>(count), active_only, t_first_.value_or(0));
    if (auto r = submit(c); !r) return r.error();
    const uint64_t half = pipeline_->half_events();
    return pending<std::vector<Event>>(event_pool_, std::move(*query), [half, order](EventQuery& q) {
      const uint64_t total = *q.target->total.mapped_as<uint32_t>();
      const uint64_t in_first = std::min(total, half);
      std::vector<Event> events(total);
      std::memcpy(events.data(), q.target->first.mapped(), in_first * sizeof(Event));
      std::memcpy(events.data() + in_first, q.target->second.mapped(), (total - in_first) * sizeof(Event));
      return ordered(std::move(events), order);
    });
  }

  Pending<Snapshot> snapshot() {
    std::lock_guard lock(mutex_);
    if (auto r = prepare_query(); !r) return r.error();
    auto query = snapshot_pool_.take(kIdleLimit, [this] { return make_snapshot_query(); });
    if (!query) return query.error();
    Commands& c = (*query)->commands;
    if (auto r = begin(c); !r) return r.error();
    c.copy(pipeline_->totals(), 0, (*query)->totals, 0, (*query)->totals.size());
    c.copy(pipeline_->slots(), 0, (*query)->slots, 0, (*query)->slots.size());
    c.mark("copy");
    if (auto r = submit(c); !r) return r.error();
    return pending<Snapshot>(
        snapshot_pool_, std::move(*query), [g = geometry_, t_first = t_first_.value_or(0)](SnapshotQuery& q) {
          return unpack_state(g, t_first, q.totals.mapped_as<uint64_t>(), q.slots.mapped_as<uint64_t>());
        });
  }

  std::vector<StageTime> stage_times() {
    std::lock_guard lock(mutex_);
    // Objects that are still lent out or in flight are counted when they are used again.
    const auto collect_idle = [this](auto& pool) {
      for (auto& object : pool.idle()) {
        const auto done = compute_of(*object).done();
        if (done && *done) collect(compute_of(*object));
      }
    };
    collect_idle(push_pool_);
    collect_idle(image_pool_);
    collect_idle(event_pool_);
    collect_idle(snapshot_pool_);
    std::vector<StageTime> times;
    for (const auto& [stage, time] : stage_times_) times.push_back(time);
    return times;
  }

  uint64_t memory_bytes() {
    std::lock_guard lock(mutex_);
    uint64_t bytes = pipeline_->memory_bytes() + query_bytes_;
    for (const StagingSlot& s : staging_) bytes += s.host.size() + s.device.size();
    return bytes;
  }

 private:
  static Snapshot unpack_state(const Geometry& g, int64_t t_first, const uint64_t* totals,
                               const uint64_t* slots) {
    Snapshot s;
    s.geometry = g;
    s.totals.assign(totals, totals + g.patches());
    s.slots.resize(g.patches() * g.capacity);
    for (int64_t patch = 0; patch < g.patches(); ++patch) {
      const int32_t x = g.x.field_begin(static_cast<int32_t>(patch % g.x.grid));
      const int32_t y = g.y.field_begin(static_cast<int32_t>(patch / g.x.grid));
      const int64_t ring = patch * g.capacity;
      for (int64_t i = ring; i < ring + s.filled(patch); ++i) s.slots[i] = unpack(slots[i], x, y, t_first);
    }
    return s;
  }

  // After a failed push, part of a batch may be stored: the stream then refuses everything until reset().
  Error fail(Error e) {
    failure_ = Error{e.code, text("the stream is incomplete since a push failed: ", e.message)};
    return e;
  }
  Result<void> usable() const { return failure_ ? Result<void>(*failure_) : Result<void>(); }

  Result<void> ready_to_push() const {
    if (!acquired_) return usable();
    return Error{ErrorCode::illegal_parameter,
                 "staging memory is acquired: commit it before the next push or acquire"};
  }

  // A query sees all events pushed so far.
  Result<void> prepare_query() {
    if (auto r = usable(); !r) return r;
    return submit_open();
  }

  // Shaders read host memory where that is device memory too; elsewhere events are copied, by the transfer
  // queue if the device has one.
  Upload upload_path(const Buffer& host) const {
    const Upload wish = device_.options().upload;
    if (wish != Upload::automatic || host.device_local()) return wish;
    return device_.compute().family() == device_.transfer().family() ? Upload::staged
                                                                     : Upload::transfer_queue;
  }

  Result<StagingSlot> make_slot() {
    const uint64_t bytes = max_acquire() * sizeof(Event);
    StagingSlot s;
    auto host = Buffer::create(device_, "the staging memory", bytes, MemoryUse::upload);
    if (!host) return host.error();
    s.host = std::move(*host);
    upload_ = upload_path(s.host);
    if (upload_ != Upload::automatic) {
      auto device = Buffer::create(device_, "the event memory", bytes, MemoryUse::device);
      if (!device) return device.error();
      s.device = std::move(*device);
    }
    auto kernels = pipeline_->bind_events(upload_ == Upload::automatic ? s.host : s.device);
    if (!kernels) return kernels.error();
    s.kernels = std::move(*kernels);
    return s;
  }

  size_t room(const StagingSlot& s) const { return max_acquire() - s.fill; }

  // The slot that gathers events, with room for n.
  Result<StagingSlot*> open_slot(size_t n) {
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
      s.begin = s.fill = 0;
    }
    return &staging_[open_];
  }

  // Submits the gathered events, if there are any. If that fails they stay where they are.
  Result<void> submit_open() {
    StagingSlot& s = staging_[open_];
    if (s.begin == s.fill) return {};
    auto commands = take_commands();
    if (!commands) return commands.error();
    const Result<void> submitted = submit_push(**commands, s);
    // Also after a failure: the transfer may be in flight.
    push_pool_.give_back(std::move(*commands));
    if (!submitted) return submitted;
    s.last_use = last_submission_;
    s.begin = s.fill;
    if (!acquired_) advance();
    return {};
  }

  Result<void> submit_push(PushCommands& commands, const StagingSlot& s) {
    Commands& c = commands.compute;
    const vulkan::Queue* wait_queue = nullptr;
    uint64_t wait_value = 0;
    const uint64_t offset = s.begin * sizeof(Event);
    const uint64_t bytes = (s.fill - s.begin) * sizeof(Event);
    if (upload_ == Upload::transfer_queue) {
      Commands& t = commands.transfer;
      if (auto r = t.wait(); !r) return r;
      if (auto r = t.begin(); !r) return r;
      t.copy(s.host, offset, s.device, offset, bytes);
      if (auto r = t.submit(); !r) return r;
      wait_queue = &device_.transfer();
      wait_value = last_transfer_ = t.value();
    }
    if (auto r = c.begin(); !r) return r;
    if (upload_ == Upload::staged) {
      c.copy(s.host, offset, s.device, offset, bytes);
      c.barrier();
      c.mark("upload");
    }
    pipeline_->record_push(c, s.kernels, s.begin, s.fill - s.begin, t_first_.value_or(0));
    return submit(c, wait_queue, wait_value);
  }

  // Moves on to the next slot if that is free, so that the next batch does not have to fit into what is left
  // of this one.
  void advance() {
    const size_t next = (open_ + 1) % staging_.size();
    const auto done = device_.compute().done(staging_[next].last_use);
    if (!done || !*done) return;
    open_ = next;
    staging_[next].begin = staging_[next].fill = 0;
  }

  Result<std::unique_ptr<PushCommands>> take_commands() {
    auto commands = push_pool_.take(kIdleLimit, [this]() -> Result<std::unique_ptr<PushCommands>> {
      auto made = std::make_unique<PushCommands>();
      auto compute = Commands::create(device_, device_.compute());
      if (!compute) return compute.error();
      made->compute = std::move(*compute);
      if (upload_ == Upload::transfer_queue) {
        auto transfer = Commands::create(device_, device_.transfer());
        if (!transfer) return transfer.error();
        made->transfer = std::move(*transfer);
      }
      return made;
    });
    if (commands) collect((*commands)->compute);
    return commands;
  }

  Result<Buffer> readback(const char* name, uint64_t bytes) {
    auto buffer = Buffer::create(device_, name, bytes, MemoryUse::readback);
    if (buffer) query_bytes_ += buffer->size();
    return buffer;
  }

  Result<std::unique_ptr<ImageQuery>> make_image_query() {
    auto commands = Commands::create(device_, device_.compute());
    if (!commands) return commands.error();
    auto result = readback("the image for the host", pipeline_->picture().size());
    if (!result) return result.error();
    return std::make_unique<ImageQuery>(ImageQuery{std::move(*commands), std::move(*result)});
  }

  Result<std::unique_ptr<EventQuery>> make_event_query() {
    auto commands = Commands::create(device_, device_.compute());
    if (!commands) return commands.error();
    auto target = pipeline_->make_extract_target();
    if (!target) return target.error();
    query_bytes_ += (*target)->total.size() + (*target)->first.size() + (*target)->second.size();
    return std::make_unique<EventQuery>(EventQuery{std::move(*commands), std::move(*target)});
  }

  Result<std::unique_ptr<SnapshotQuery>> make_snapshot_query() {
    auto commands = Commands::create(device_, device_.compute());
    if (!commands) return commands.error();
    auto totals = readback("the totals for the host", pipeline_->totals().size());
    if (!totals) return totals.error();
    auto slots = readback("the ring buffers for the host", geometry_.patches() * geometry_.capacity * 8);
    if (!slots) return slots.error();
    return std::make_unique<SnapshotQuery>(
        SnapshotQuery{std::move(*commands), std::move(*totals), std::move(*slots)});
  }

  Result<void> begin(Commands& c) {
    collect(c);
    return c.begin();
  }

  Result<void> submit(Commands& c, const vulkan::Queue* wait_queue = nullptr, uint64_t wait_value = 0) {
    if (auto r = c.submit(wait_queue, wait_value); !r) return r;
    last_submission_ = c.value();
    return {};
  }

  // Times of finished commands. A failure here loses a measurement, not a result.
  void collect(Commands& c) {
    const auto spans = c.take_times();
    if (!spans) return;
    for (const vulkan::StageSpan& span : *spans) {
      StageTime& time = stage_times_[std::string(span.stage)];
      time.stage = span.stage;
      time.dispatches += 1;
      time.nanoseconds += span.nanoseconds;
    }
  }

  // A query in flight; its object goes back to the pool when the Pending result is gone.
  template <class T, class Query, class Read>
  Pending<T> pending(Pool<Query>& pool, std::unique_ptr<Query> query, Read read) {
    struct Lease {
      std::shared_ptr<Stream> stream;
      Pool<Query>* pool;
      std::unique_ptr<Query> query;
      ~Lease() {
        std::lock_guard lock(stream->mutex_);
        pool->give_back(std::move(query));
      }
    };
    std::shared_ptr<Lease> lease(new Lease{shared_from_this(), &pool, std::move(query)});
    return Pending<T>(
        [lease] {
          const auto done = lease->query->commands.done();
          return !done || *done;
        },
        [lease, read]() mutable -> Result<T> {
          if (auto r = lease->query->commands.wait(); !r) return r.error();
          return read(*lease->query);
        });
  }

  std::shared_ptr<GpuContext> context_;  // first, so that the device outlives all that follows
  vulkan::Device& device_;
  const Geometry geometry_;
  const GpuOptions options_;
  std::mutex mutex_;
  std::unique_ptr<ScarfPipeline> pipeline_;
  Upload upload_ = Upload::automatic;  // automatic: shaders read the staging memory itself
  std::vector<StagingSlot> staging_;
  size_t open_ = 0;                 // the staging slot that gathers events
  std::optional<size_t> acquired_;  // events handed out by acquire, behind the gathered ones
  std::optional<int64_t> t_first_;
  std::optional<Error> failure_;
  uint64_t last_submission_ = 0;  // places in the timelines of the two queues
  uint64_t last_transfer_ = 0;
  uint64_t query_bytes_ = 0;
  Pool<PushCommands> push_pool_;
  Pool<ImageQuery> image_pool_;
  Pool<EventQuery> event_pool_;
  Pool<SnapshotQuery> snapshot_pool_;
  std::map<std::string, StageTime> stage_times_;
};

class DeviceScarf final : public GpuScarf {
 public:
  explicit DeviceScarf(std::shared_ptr<Stream> stream) : stream_(std::move(stream)) {}

  const Geometry& geometry() const override { return stream_->geometry(); }
  Result<PushReport> push(std::span<const Event> events) override { return stream_->push(events); }
  Result<void> reset() override { return stream_->reset(); }
  Result<std::span<Event>> acquire(size_t n) override { return stream_->acquire(n); }
  Result<PushReport> commit(size_t count) override { return stream_->commit(count); }
  size_t max_acquire() const override { return stream_->max_acquire(); }
  Result<void> flush() override { return stream_->flush(); }
  Result<void> finish() override { return stream_->finish(); }
  std::vector<StageTime> stage_times() const override { return stream_->stage_times(); }
  uint64_t memory_bytes() const override { return stream_->memory_bytes(); }

  Pending<Image<int32_t>> count_image(PolarityMode mode) override { return stream_->image<int32_t>(mode); }
  Pending<Image<uint8_t>> u8_image(PolarityMode mode) override {
    if (auto r = check_dense_mode(mode); !r) return r.error();
    return stream_->image<uint8_t>(mode);
  }
  Pending<Image<float>> float_image(PolarityMode mode) override {
    if (auto r = check_dense_mode(mode); !r) return r.error();
    return stream_->image<float>(mode);
  }
  Pending<std::vector<Event>> active_events(EventOrder order) override {
    return stream_->events(0, geometry().patches(), /*active_only=*/true, order);
  }
  Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) override {
    if (auto r = check_patch(geometry(), patch); !r) return r.error();
    return stream_->events(patch, 1, active_only, EventOrder::by_patch);
  }
  Pending<Snapshot> snapshot() override { return stream_->snapshot(); }

 private:
  std::shared_ptr<Stream> stream_;
};

}  // namespace

Result<std::unique_ptr<GpuScarf>> make_gpu_scarf(std::shared_ptr<GpuContext> context,
                                                 const Geometry& geometry, double accumulation,
                                                 const GpuOptions& options) {
  const auto checked = checked_geometry(geometry);
  if (!checked) return checked.error();
  const auto levels = make_levels(accumulation, geometry.capacity);
  if (!levels) return levels.error();
  auto stream = std::make_shared<Stream>(std::move(context), *checked, options);
  if (auto r = stream->start(*levels); !r) return r.error();
  return std::unique_ptr<GpuScarf>(std::make_unique<DeviceScarf>(std::move(stream)));
}

}  // namespace scarf
