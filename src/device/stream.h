// A stream of events on a device: staging of batches, queries in flight, threads and failures. What the
// events are for is the pipeline's business.
#pragma once

#include <atomic>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "device/push_commands.h"
#include "kernels/event_unpacker.h"
#include "kernels/pipeline.h"
#include "kernels/stage_times.h"
#include "kernels/staging.h"
#include "layout/event_packer.h"
#include "scarf/device/stream.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"
#include "vulkan/pool.h"

namespace scarf {

/// What a query needs while it is in flight; used again afterwards.
struct Query {
  vulkan::Commands commands;
  std::vector<vulkan::Buffer> results;  ///< copies of Answer::parts, for the host
  std::unique_ptr<QueryMemory> memory;  ///< of the pipeline

  /// Errors: out_of_memory.
  static Result<std::unique_ptr<Query>> create(vulkan::Device& device);

  uint64_t memory_bytes() const;
  /// Copies the parts into results `first` and on, which grow as needed.
  Result<void> copy_back(vulkan::Device& device, std::span<const Part> parts, size_t first = 0);
};
inline vulkan::Commands& compute_of(Query& query) {
  return query.commands;
}

/// Queries of one kind need similar memory.
enum class QueryKind { image, events, state };
inline constexpr size_t kQueryKinds = 3;

class WordFeed;

/// Everything of a stream. Pending results share it, so that they may outlive the Representation.
class Stream : public std::enable_shared_from_this<Stream> {
 public:
  /// Errors: illegal_parameter for options out of range; out_of_memory.
  static Result<std::shared_ptr<Stream>> create(std::shared_ptr<GpuContext> context,
                                                std::unique_ptr<Pipeline> pipeline,
                                                const GpuOptions& options);
  ~Stream();

  vulkan::Device& device() { return device_; }
  SensorSize sensor() const { return pipeline_->sensor(); }

  // See Representation and GpuRepresentation.
  Result<PushReport> push(std::span<const Event> events);
  Result<std::span<Event>> acquire(size_t n);
  Result<PushReport> commit(size_t count);
  size_t max_acquire() const { return pipeline_->submission_events(); }
  Result<void> flush();
  Result<void> finish();
  Result<void> reset();
  std::vector<StageTime> stage_times();
  uint64_t memory_bytes();

  /// Submits what was gathered, then what `record(Query&, const StreamFacts&)` records, and hands over what
  /// the Result<Answer<T>> reads that it returns. `changes_state`: the recorded work does; should it not get
  /// to the device, the stream is broken.
  template <class T, class Record>
  Pending<T> query(QueryKind kind, const Record& record, bool changes_state = false) {
    return ask<T>(kind, std::cref(record), changes_state);
  }

  /// Runs a call of the public interface: under the lock, in the process that made the device, and with lack
  /// of memory as an error.
  template <class Call>
  std::invoke_result_t<Call&> exclusively(Call call) {
    using Answer = std::invoke_result_t<Call&>;
    return as_result([&]() -> Answer {
      if (auto r = device_.check_process(); !r) return r.error();
      std::lock_guard lock(mutex_);
      return call();
    });
  }

 private:
  friend class WordFeed;     // the other way into a stream: words instead of events
  friend class StreamGroup;  // submits for several streams
  using Upload = DeviceOptions::Upload;

  // Staging memory. Events begin .. fill-1 are pushed but not yet submitted, those before are in flight or
  // done. Where shaders read it themselves it holds events as they are; what is copied is packed.
  struct StagingSlot {
    StagedBuffer memory;
    std::unique_ptr<EventBinding> binding;  // of events as they are
    EventPacker packer;
    EventPacker::Part part;  // of the events that are about to be submitted
    vulkan::BoundKernel unpack;
    uint32_t begin = 0;
    uint32_t fill = 0;
    uint64_t last_use = 0;  // place in the compute timeline
  };

  Stream(std::shared_ptr<GpuContext> context, std::unique_ptr<Pipeline> pipeline, const GpuOptions& options);
  Result<void> start();

  // std::function of a reference allocates nothing.
  template <class T>
  using Record = std::function<Result<Answer<T>>(Query& query, const StreamFacts& facts)>;
  template <class T>
  Pending<T> ask(QueryKind kind, const Record<T>& record, bool changes_state);

  Error fail(const Error& e) noexcept;
  Result<void> usable() const noexcept;
  Result<void> ready_to_push() const;

  Result<StagingSlot> make_slot();
  bool packed() const { return upload_ != Upload::automatic; }
  size_t room(const StagingSlot& s) const { return packed() ? s.packer.room() : max_acquire() - s.fill; }
  Result<void> store(std::span<const Event> events, size_t& stored);
  void append(StagingSlot& s, std::span<const Event> events);
  Event* lend(StagingSlot& s, size_t n);
  Result<StagingSlot*> open_slot(size_t n);
  Result<void> submit_gathered();
  Result<void> submit_open();
  Result<bool> prepare_gathered();
  // The steps of submit_open: whether there is anything to submit; its copies to the device, if there are
  // any, and its work, for which the pipeline is ready; and what follows from a submission.
  Result<bool> prepare_open();
  void record_copies(vulkan::Commands& commands) const;
  void record_open(vulkan::Commands& commands);
  void open_is_submitted();
  void empty(StagingSlot& s);
  void advance();

  Result<std::unique_ptr<PushCommands>> take_commands();
  Result<void> begin_with_upload(PushCommands& commands, const std::function<void(vulkan::Commands&)>& copy);
  Result<void> submit(PushCommands& commands);
  Result<std::unique_ptr<Query>> take_query(QueryKind kind);
  Result<void> submit(Query& query);

  std::shared_ptr<GpuContext> context_;  // first, so that the device outlives all that follows
  vulkan::Device& device_;
  const GpuOptions options_;
  std::mutex mutex_;
  std::unique_ptr<Pipeline> pipeline_;
  Upload upload_ = Upload::automatic;               // automatic: shaders read the staging memory itself
  EventUnpacker unpacker_;                          // where events are packed; so are the next two
  std::unique_ptr<EventBinding> unpacked_binding_;  // of its events
  std::vector<Event> lent_;                         // what acquire hands out
  std::vector<StagingSlot> staging_;
  size_t open_ = 0;                 // the staging slot that gathers events
  std::optional<size_t> acquired_;  // events handed out by acquire, behind the gathered ones
  WordFeed* words_ = nullptr;       // gathers words while no events are gathered, and the other way round
  StreamFacts facts_;               // of all events pushed
  std::optional<Error> failure_;
  uint64_t last_submission_ = 0;  // places in the timelines of the two queues
  uint64_t last_transfer_ = 0;
  std::atomic<uint64_t> query_bytes_ = 0;
  Pool<PushCommands> push_pool_;
  Pool<Query> query_pools_[kQueryKinds];
  StageTimes stage_times_;
};

}  // namespace scarf
