// SCARF on a Vulkan device.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarf/filter.h"
#include "scarf/parameters.h"
#include "scarf/scarf.h"

namespace scarf {

/// A Vulkan device as scarf sees it.
struct DeviceInfo {
  uint32_t index = 0;       ///< position in list_devices(), which is ranked: the best device first
  std::string name;         ///< as the driver calls it
  std::string type;         ///< "discrete", "integrated", "virtual", "cpu" or "other"
  std::string uuid;         ///< 32 hexadecimal digits
  std::string driver;       ///< driver name and version
  std::string api_version;  ///< "1.3.224"
  uint64_t memory = 0;      ///< bytes of the largest device-local heap
  std::string rejected;     ///< why scarf cannot use it; empty if it can
};

/// All Vulkan devices, ranked discrete > integrated > virtual > CPU, usable ones first.
/// Errors: device, if there is no Vulkan driver at all.
Result<std::vector<DeviceInfo>> list_devices();

struct DeviceOptions {
  /// Index, part of the name, UUID or type of the device. Empty: the environment variable SCARF_DEVICE, and
  /// without that the best-ranked usable device.
  std::string device;
  /// A CPU device (such as lavapipe) is an error. Also set by a non-empty environment variable
  /// SCARF_REQUIRE_GPU.
  bool require_gpu = false;
  /// How events reach the device. automatic: shaders read the staging memory itself where that is device
  /// memory which the host also reads fast; elsewhere events are packed and copied, by a transfer queue if
  /// there is one. The others force a path, so that each can be tested on any device.
  enum class Upload { automatic, staged, transfer_queue } upload = Upload::automatic;
  /// Khronos validation layers on; every message is collected by GpuContext::validation_messages().
  bool validation = false;
  /// Fills fresh device memory with 0xA5 and surrounds buffers with guard words: for tests.
  bool poison_memory = false;
  /// Folder of the pipeline cache. Empty: $XDG_CACHE_HOME/scarf or ~/.cache/scarf. "-": no cache on disk.
  std::string cache_folder;
};

namespace vulkan {
class Device;
}

/// A Vulkan device in use. Any number of streams may share it, from any threads. It belongs to the process
/// that made it: in a forked child every call of the context's streams, groups and so on returns an error
/// (device), and their destructors leave the device alone; the child may make a context of its own.
class GpuContext {
 public:
  /// Errors: device, if no device fits the options; the message lists every device and why it was rejected.
  static Result<std::shared_ptr<GpuContext>> create(const DeviceOptions& options = {});
  ~GpuContext();

  const DeviceInfo& device() const;
  /// What the validation layers said so far; empty is good.
  std::vector<std::string> validation_messages() const;

  /// The Vulkan layer below, for the pipelines of this library.
  vulkan::Device& vulkan() { return *device_; }
  explicit GpuContext(std::unique_ptr<vulkan::Device> device);

 private:
  std::unique_ptr<vulkan::Device> device_;
};

struct GpuOptions {
  /// What push does when every staging slot is in flight: wait, or return ErrorCode::would_block.
  /// With would_block a large batch may be taken in part: PushReport::accepted tells how much.
  enum class WhenFull { wait, would_block } when_full = WhenFull::wait;
  /// Staging slots: batches that can be in flight at a time; 1 to 16.
  uint32_t staging_slots = 3;
  /// Events per submission; 0: chosen for the device. Larger batches are split, smaller ones are gathered
  /// until a query or flush() needs them. Never changes a result.
  uint32_t submission_events = 0;
  /// Events walked by one team of invocations; 0: chosen for the device. Never changes a result.
  uint32_t chunk_events = 0;
  /// How events of scarf get into the rings: as chunks side by side, or one after the other from the rings'
  /// heads on, for several parts of the patches side by side. automatic: as suits device and submission, but
  /// chunks if chunk_events is given. Never changes a result.
  enum class Placing { automatic, chunked, appended } placing = Placing::automatic;
  /// Bands of rows of patches that a core works on one after the other; 0: chosen for the device, at most 64.
  /// Never changes a result.
  uint32_t bands = 0;
};

/// Device time of one stage, summed over the submissions that were measured.
struct StageTime {
  std::string stage;  ///< "count", "scan", "place", "render", "tone", ...
  uint64_t dispatches = 0;
  uint64_t nanoseconds = 0;
};

/// A representation in device memory. push() returns when the events are in staging memory; see
/// Representation for the rest.
class GpuRepresentation : public virtual Representation {
 public:
  /// Staging memory for n events (up to max_acquire()), to be filled in place: the first `count` of them
  /// become the next batch at commit(). Acquire and commit belong to the pushing thread, and alternate; a
  /// reset() between them makes them the first batch of the new stream. Errors: illegal_parameter if n is
  /// above max_acquire(), would_block as in push.
  virtual Result<std::span<Event>> acquire(size_t n) = 0;
  virtual Result<PushReport> commit(size_t count) = 0;
  virtual size_t max_acquire() const = 0;

  /// Starts work on all events pushed so far; does not wait for it.
  virtual Result<void> flush() = 0;
  /// Waits until all work asked for so far is done.
  virtual Result<void> finish() = 0;

  /// Device time per stage since construction; empty where the device has no timestamps.
  virtual std::vector<StageTime> stage_times() const = 0;
  /// Device and host-visible memory held by this stream, in bytes.
  virtual uint64_t memory_bytes() const = 0;
};

/// A SCARF state in device memory.
class GpuScarf : public Scarf, public GpuRepresentation {};

/// Errors: illegal_parameter as checked_geometry and make_levels, and for a null context; out_of_memory,
/// naming the size and the limit, if the state does not fit the device.
Result<std::unique_ptr<GpuScarf>> make_gpu_scarf(std::shared_ptr<GpuContext> context,
                                                 const Geometry& geometry,
                                                 double accumulation = kDefaultAccumulation,
                                                 const GpuOptions& options = {},
                                                 std::span<const FilterParameters> filters = {});

/// Any representation on a sensor, behind the filters, if there are any (time_window with `counts` cannot
/// be). Errors: illegal_parameter as checked_parameters, for a sensor that the representation cannot be on,
/// and for a null context; device, if the device lacks something that it needs; out_of_memory.
Result<std::unique_ptr<GpuRepresentation>> make_gpu_representation(
    std::shared_ptr<GpuContext> context, const Parameters& parameters, SensorSize sensor,
    const GpuOptions& options = {}, std::span<const FilterParameters> filters = {});

}  // namespace scarf
