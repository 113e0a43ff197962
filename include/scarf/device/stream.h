// Representations on a Vulkan device.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scarf/core/filter.h"
#include "scarf/core/parameters.h"
#include "scarf/core/patch_state.h"
#include "scarf/device/context.h"
#include "scarf/device/tuning.h"

namespace scarf {

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
