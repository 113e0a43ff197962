// A representation: a picture that a stream of events keeps up to date, behind one interface for all.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/image.h"
#include "scarf/core/pending.h"
#include "scarf/core/result.h"

namespace scarf {

/// What became of the events of one push.
struct PushReport {
  uint64_t accepted = 0;  ///< events taken from the front of the batch, those outside the sensor included
  uint64_t outside = 0;   ///< accepted events outside the sensor: counted and dropped
};

/// What became of the events of a stream at one noise filter in front of it (scarf/core/filter.h).
struct FilterReport {
  uint64_t passed = 0;    ///< inside the sensor and handed on
  uint64_t rejected = 0;  ///< inside the sensor and not handed on
  uint64_t outside = 0;   ///< outside the sensor: handed on untouched, for the representation to count

  friend bool operator==(const FilterReport&, const FilterReport&) = default;
};

/// The time of a pixel that never fired, in raw images and states.
inline constexpr int64_t kNeverFired = INT64_MIN;

/// One stream's representation. What each one is, and which parameters it has: scarf/core/parameters.h.
/// Implementations (the CPU reference, the GPU) agree bit for bit on everything they hand out, for any stream
/// and any way of cutting it into batches; aed_sae and aae agree within the bounds of
/// docs/REPRESENTATIONS.md.
///
/// Threads: one thread pushes and resets; any thread queries. A query sees exactly the pushes that returned
/// before it was asked. It never changes what later queries show, except for aae and for chain_sae with
/// Rule::event_driven, where docs/REPRESENTATIONS.md says so.
class Representation {
 public:
  virtual ~Representation() = default;

  virtual SensorSize sensor() const = 0;

  /// Appends a batch (any size, 0 included). Events outside the sensor are counted and dropped.
  /// Errors: refused_batch, naming the event, if an event inside the sensor has p > 1 or is 2^48 us or more
  /// away from the stream's first event; then nothing of the batch is stored. After any other error (such as
  /// out_of_memory) that is so as well, or part of it is stored: then every call says so until reset().
  virtual Result<PushReport> push(std::span<const Event> events) = 0;

  /// Empties the state, as if newly made.
  virtual Result<void> reset() = 0;

  /// The picture, height x width, 8 bits. `now` is the time that the picture is for, in microseconds; without
  /// it the time of the newest event. Only time_window and sae depend on it.
  virtual Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now = {}) = 0;
  /// The picture, height x width, in [0, 1] (scarf and aae: not clipped).
  virtual Pending<Image<float>> float_image(std::optional<int64_t> now = {}) = 0;
  /// The integers behind the picture: scarf stored active events, time_window the last time or the count, sae
  /// the last times (plane 0 = OFF, plane 1 = ON), eros and tos the age (65,535: never fired), sits the
  /// value, chain_sae the rank (-1: no rank), aed_sae the last time, aae how often a pixel is drawn. Times
  /// are microseconds, or kNeverFired.
  virtual Pending<Image<int64_t>> raw_image() = 0;
  /// The sparse events behind the picture, where there are any: the active ones of scarf (by patch), the
  /// queues of aae (by block), those of the window of time_window (in order of arrival; with `counts` only).
  /// Within a patch or block from oldest to newest.
  /// Errors: illegal_parameter, naming the representations that keep events, for the others.
  virtual Pending<std::vector<Event>> events() = 0;
  /// All that later pictures depend on, as little-endian bytes: equal states have equal bytes, whoever made
  /// them. The layout is in docs/REPRESENTATIONS.md.
  virtual Pending<std::vector<uint8_t>> state() = 0;
  /// The noise filters in front, in their order; empty without any.
  virtual Pending<std::vector<FilterReport>> filter_reports() { return std::vector<FilterReport>(); }
};

}  // namespace scarf
