// SCARF: a set of centre active receptive fields, behind one interface for every implementation.
// Source: "An Event Preserving Velocity Invariant Representation for Event Cameras", 2026.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarf/event.h"
#include "scarf/geometry.h"
#include "scarf/image.h"
#include "scarf/pending.h"
#include "scarf/result.h"

namespace scarf {

/// What became of the events of one push.
struct PushReport {
  uint64_t accepted = 0;  ///< events taken from the front of the batch, those outside the sensor included
  uint64_t outside = 0;   ///< accepted events outside the sensor: counted and dropped
};

/// Everything a SCARF state is: what the state digest covers.
struct Snapshot {
  Geometry geometry;
  std::vector<uint64_t> totals;  ///< per patch: events ever pushed into it
  std::vector<Event> slots;  ///< patch-major, `capacity` slots per patch in slot order; all-zero where empty

  int64_t filled(size_t patch) const {
    const auto capacity = static_cast<uint64_t>(geometry.capacity);
    return static_cast<int64_t>(totals[patch] < capacity ? totals[patch] : capacity);
  }
  std::span<const Event> ring(size_t patch) const {
    return std::span(slots).subspan(patch * geometry.capacity, geometry.capacity);
  }
};

/// Order of extracted events. Both orders list the events of a patch from oldest to newest.
enum class EventOrder {
  by_patch,  ///< patch id ascending
  by_time,   ///< merged by t; equal times keep the by_patch order
};

/// One stream's SCARF state. Implementations (the CPU reference, the GPU) agree bit for bit on everything
/// they hand out, for any stream and any way of cutting it into batches.
///
/// Threads: one thread pushes and resets; any thread queries. A query sees exactly the pushes that returned
/// before it was asked, and never changes the state.
class Scarf {
 public:
  virtual ~Scarf() = default;

  virtual const Geometry& geometry() const = 0;

  /// Appends a batch (any size, 0 included). Events outside the sensor are counted and dropped.
  /// Errors: refused_batch, naming the event, if an event inside the sensor has p > 1 or is 2^48 us or more
  /// away from the stream's first event; then nothing of the batch is stored.
  virtual Result<PushReport> push(std::span<const Event> events) = 0;

  /// Empties the state, as if newly made.
  virtual Result<void> reset() = 0;

  /// Stored active events per pixel; 0 where no patch is active.
  virtual Pending<Image<int32_t>> count_image(PolarityMode mode = PolarityMode::merged) = 0;
  /// Dense image, 8 bits: Levels::u8 of the counts. PolarityMode::difference is refused.
  virtual Pending<Image<uint8_t>> u8_image(PolarityMode mode = PolarityMode::merged) = 0;
  /// Dense image, float: Levels::f32 of the counts. PolarityMode::difference is refused.
  virtual Pending<Image<float>> float_image(PolarityMode mode = PolarityMode::merged) = 0;

  /// All active stored events, with the coordinates and times they were pushed with.
  virtual Pending<std::vector<Event>> active_events(EventOrder order = EventOrder::by_patch) = 0;
  /// The stored events of one patch, oldest to newest: all of them, or the active ones only.
  /// Errors: illegal_parameter for a patch id outside 0 .. patches - 1.
  virtual Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) = 0;
  /// Totals and every slot.
  virtual Pending<Snapshot> snapshot() = 0;
};

}  // namespace scarf
