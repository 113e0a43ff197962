// What a representation is to the stream that feeds it: work to be recorded, buffers to be copied back.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/image.h"
#include "scarf/core/result.h"
#include "vulkan/commands.h"

namespace scarf {

/// What the host knows of a stream: times of its events inside the sensor, in microseconds (nullopt: no event
/// yet), and how many were outside.
struct StreamFacts {
  std::optional<int64_t> first;    ///< of the first event
  std::optional<int64_t> newest;   ///< of the last event to arrive
  std::optional<int64_t> largest;  ///< of any event
  uint64_t outside = 0;
};

/// Kernels bound to one buffer of events; each pipeline has its own kind.
struct EventBinding {
  virtual ~EventBinding() = default;
};

/// The state of one stream in device memory. Knows nothing of threads, staging or waiting: calls come one at
/// a time, and what they record is run in their order.
class Pipeline {
 public:
  virtual ~Pipeline() = default;

  virtual SensorSize sensor() const = 0;
  /// Most events of one record_push.
  virtual uint32_t submission_events() const = 0;
  /// Binds a buffer of events (16 bytes each). The buffer object may be moved afterwards: keep no pointer to
  /// it.
  virtual Result<std::unique_ptr<EventBinding>> bind_events(const vulkan::Buffer& events) = 0;

  /// Empties the state.
  virtual void record_reset(vulkan::Commands& commands) = 0;
  /// What must be done before `count` more events can be recorded; the default is nothing. May wait for the
  /// device. Errors: out_of_memory, if there is no room for them; then nothing has changed.
  virtual Result<void> prepare_push(uint32_t count);
  /// Events first .. first+count-1 of the bound buffer join the state. `times` include them.
  virtual void record_push(vulkan::Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                           const StreamFacts& facts) = 0;

  /// What was recorded since the last submission, a push or a part of one, will never get to the device: what
  /// the pipeline concluded from it does not hold. The default: it concludes nothing.
  virtual void recording_lost() {}

  /// Device memory of the state.
  virtual uint64_t memory_bytes() const = 0;
};

/// The first bytes of a buffer, to be copied to the host.
struct Part {
  const vulkan::Buffer* buffer = nullptr;
  uint64_t bytes = 0;
};

/// The copies of the parts, in their order.
using HostParts = std::span<const void* const>;

/// What the host has to copy back for a query, and how it reads the copies. `read` runs later, perhaps on
/// another thread, so it must not look at the pipeline.
template <class T>
struct Answer {
  std::vector<Part> parts;
  std::function<Result<T>(HostParts)> read;
};

/// What a pipeline may attach to the queries that it answers, to find it there again.
struct QueryMemory {
  virtual ~QueryMemory() = default;
  virtual uint64_t memory_bytes() const = 0;
};

/// Runs what `record` records at once, after everything submitted so far, and waits for it: for work that
/// must be known to be done before a pipeline goes on.
Result<void> run_alone(vulkan::Device& device, const std::function<void(vulkan::Commands&)>& record);

/// A pipeline with the queries of Representation.
class ImagePipeline : public Pipeline {
 public:
  // Each records what its query needs. `now`: see Representation.
  virtual Result<Answer<Image<uint8_t>>> record_u8(vulkan::Commands& commands, const StreamFacts& facts,
                                                   std::optional<int64_t> now) = 0;
  virtual Result<Answer<Image<float>>> record_float(vulkan::Commands& commands, const StreamFacts& facts,
                                                    std::optional<int64_t> now) = 0;
  virtual Result<Answer<Image<int64_t>>> record_raw(vulkan::Commands& commands, const StreamFacts& facts) = 0;
  virtual Result<Answer<std::vector<uint8_t>>> record_state(vulkan::Commands& commands,
                                                            const StreamFacts& facts) = 0;
  /// The default refuses: see Representation::events.
  virtual Result<Answer<std::vector<Event>>> record_events(vulkan::Commands& commands,
                                                           const StreamFacts& facts);
};

/// A buffer that begins with the pixels of an image.
template <class T>
Answer<Image<T>> image_answer(const vulkan::Buffer& buffer, SensorSize sensor, int32_t planes = 1);

}  // namespace scarf
