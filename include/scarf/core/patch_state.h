// SCARF: a set of centre active receptive fields, behind one interface for every implementation.
// Source: "An Event Preserving Velocity Invariant Representation for Event Cameras", 2026.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarf/core/patch_grid.h"
#include "scarf/core/representation.h"

namespace scarf {

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

/// What the state digest covers of one patch, little-endian: its total (u64), then for each filled slot in
/// slot order x u16, y u16, p u8, active u8, t i64.
std::vector<uint8_t> state_bytes(const Snapshot& snapshot, size_t patch);

/// Order of extracted events. Both orders list the events of a patch from oldest to newest.
enum class EventOrder {
  by_patch,  ///< patch id ascending
  by_time,   ///< merged by t; equal times keep the by_patch order
};

/// One stream's SCARF state: a Representation with more to ask for.
class Scarf : public virtual Representation {
 public:
  virtual const Geometry& geometry() const = 0;

  /// Stored active events per pixel; 0 where no patch is active.
  virtual Pending<Image<int32_t>> count_image(PolarityMode mode = PolarityMode::merged) = 0;
  /// Dense image, 8 bits: Levels::u8 of the counts. PolarityMode::difference is refused.
  virtual Pending<Image<uint8_t>> u8_planes(PolarityMode mode) = 0;
  /// Dense image, float: Levels::f32 of the counts. PolarityMode::difference is refused.
  virtual Pending<Image<float>> float_planes(PolarityMode mode) = 0;

  /// All active stored events, with the coordinates and times they were pushed with.
  virtual Pending<std::vector<Event>> active_events(EventOrder order = EventOrder::by_patch) = 0;
  /// The stored events of one patch, oldest to newest: all of them, or the active ones only.
  /// Errors: illegal_parameter for a patch id outside 0 .. patches - 1.
  virtual Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) = 0;
  /// Totals and every slot.
  virtual Pending<Snapshot> snapshot() = 0;

  // The Representation: both polarities alike.
  SensorSize sensor() const final { return geometry().sensor(); }
  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> = {}) final {
    return u8_planes(PolarityMode::merged);
  }
  Pending<Image<float>> float_image(std::optional<int64_t> = {}) final {
    return float_planes(PolarityMode::merged);
  }
  Pending<Image<int64_t>> raw_image() final;
  Pending<std::vector<Event>> events() final { return active_events(EventOrder::by_patch); }
  Pending<std::vector<uint8_t>> state() final;
};

}  // namespace scarf
