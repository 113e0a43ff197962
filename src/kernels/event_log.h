// The events that a representation still needs, in order of arrival, in device memory.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "kernels/pipeline.h"
#include "kernels/pipeline_builder.h"
#include "kernels/scan.h"
#include "shaders/kernels/event_log_layout.h"

namespace scarf {

/// The memory of a log, and what it is copied with. Made anew when the log grows.
struct EventLogMemory {
  uint32_t capacity = 0;   ///< events
  vulkan::Buffer events;   ///< the log
  vulkan::Buffer scratch;  ///< as large
  vulkan::Buffer places;   ///< one word per run of events, and two
  PrefixSum::Source prefix;

  struct Copy {
    vulkan::BoundKernel count, write;
  };
  Copy to_scratch, to_events;  ///< of the events that are kept
};

/// What a log asks of the pipeline that keeps it.
class EventLogOwner {
 public:
  virtual ~EventLogOwner() = default;
  /// Drops the events that are not needed any more, and waits for it: EventLog::run and record_keep.
  virtual Result<void> drop_old_events() = 0;
  /// Binds everything to the log's new memory. The device is idle. On failure nothing may have changed.
  virtual Result<void> bind_log(const EventLogMemory& memory) = 0;
};

/// Appends events inside the sensor, by counting, prefix sum and writing, so that their order is the order of
/// arrival. The exact length is known to the device; the host knows a bound. When that reaches the capacity,
/// prepare() asks the device, has old events dropped, and only then grows the memory.
class EventLog {
 public:
  struct Shape {
    SensorSize sensor;
    uint32_t first_events = 0;              ///< capacity at first
    uint32_t most_events = UINT32_MAX / 2;  ///< if the device has buffers for so many
    uint32_t keep = 0;                      ///< layout::kKeepSince or kKeepNewest: how events are dropped
    // With kKeepNewest:
    const vulkan::Buffer* keep_from = nullptr;  ///< per block: index of the first event to keep
    SensorSize block;                           ///< pixels
    uint32_t block_columns = 0;
    const char* advice = "";  ///< what users can do when there is no more room
  };

  /// What is bound to one buffer of events to be appended. Lives no longer than the log.
  class Input {
   public:
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

   private:
    friend class EventLog;
    explicit Input(EventLog& log) : log_(log) {}
    EventLog& log_;
    EventLogMemory::Copy copy_;
  };

  /// `owner` outlives the log; its bind_log is not called here.
  static Result<std::unique_ptr<EventLog>> create(vulkan::Device& device, const Shape& shape,
                                                  EventLogOwner& owner);

  Result<std::unique_ptr<Input>> bind_input(const vulkan::Buffer& events);

  void record_reset(vulkan::Commands& commands);
  /// See Pipeline::prepare_push. Errors: out_of_memory, if the events do not fit one buffer.
  Result<void> prepare(uint32_t count);
  void record_append(vulkan::Commands& commands, const Input& input, uint32_t first, uint32_t count);

  /// Copies the events that are kept from one of the buffers to the other, in order; afterwards length() is
  /// their number. `push`: start, since.
  enum class From { events, scratch };
  void record_keep(vulkan::Commands& commands, From from, layout::EventLogPush push = {});
  /// Copies the scratch buffer back into the log.
  void record_copy_back(vulkan::Commands& commands) const;

  /// Runs what is recorded and waits for it.
  Result<void> run(const std::function<void(vulkan::Commands&)>& record);
  /// The largest time in the log, INT64_MIN if it is empty. Waits for the device.
  Result<int64_t> largest_time();

  const EventLogMemory& memory() const { return *memory_; }
  const vulkan::Buffer& events() const { return memory_->events; }
  const vulkan::Buffer& length() const { return length_; }  ///< one word
  /// No fewer events than are in the log.
  uint32_t bound();
  uint64_t memory_bytes() const;

  /// For queries that copy length() back: tells the log about it, so that bound() gets close. May be called
  /// later and on any thread.
  std::function<void(const void* length)> length_reader() const;

 private:
  // The newest length that a query has brought back.
  struct KnownLength {
    std::mutex mutex;
    uint64_t generation = 0;  // of resets
    uint64_t appended = 0;    // events that had been appended by then, those outside the sensor included
    uint32_t length = 0;
  };

  EventLog(vulkan::Device& device, const Shape& shape, EventLogOwner& owner)
      : device_(device), shape_(shape), owner_(owner) {}
  Result<void> build();
  Result<std::unique_ptr<EventLogMemory>> make_memory(uint32_t capacity);
  void bind_copy(PipelineBuilder& builder, EventLogMemory::Copy& copy, const EventLogMemory& memory,
                 const vulkan::Buffer& from, const vulkan::Buffer& to, bool append) const;
  void record_copy(vulkan::Commands& commands, const EventLogMemory::Copy& copy,
                   const layout::EventLogPush& push);
  uint64_t most_events() const;
  Result<void> read_length();
  Result<void> grow(uint32_t capacity);
  Error full(uint64_t needed) const;

  vulkan::Device& device_;
  const Shape shape_;
  EventLogOwner& owner_;
  vulkan::Buffer length_, length_read_, largest_;
  PrefixSum prefix_;
  vulkan::Kernel append_count_, append_write_, keep_count_, keep_write_, largest_kernel_;
  std::unique_ptr<EventLogMemory> memory_;
  std::vector<Input*> inputs_;
  vulkan::Commands commands_;
  uint64_t fixed_bytes_ = 0;
  uint32_t bound_ = 0;
  uint64_t appended_ = 0;
  uint64_t generation_ = 0;
  std::shared_ptr<KnownLength> known_ = std::make_shared<KnownLength>();
};

/// Events as they are copied back from a log.
std::vector<Event> events_of(const void* events, const void* length);

}  // namespace scarf
