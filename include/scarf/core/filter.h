// Noise filters: streams of events that lose the events which nothing around them supports.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/parameters.h"
#include "scarf/core/representation.h"
#include "scarf/core/result.h"

namespace scarf {

/// An event passes if a pixel of its window, its own included, fired with the same polarity shortly before:
/// t - last <= period, where last is the time of the last event of that pixel and polarity to arrive before
/// it. After a backward step in time last may be larger than t; such an event passes. Every event inside the
/// sensor supports later ones, whether it passed or not.
/// Source: Delbruck, "Frame-free dynamic digital vision", 2008.
struct SupportFilter {
  int32_t range = 1;         ///< window of (2 * range + 1)^2 pixels, clipped to the sensor; 1 to 7
  int64_t period = 100'000;  ///< microseconds, 1 to 1e9
};

/// An event is rejected if its pixel is blind: last <= t < last + period, where last is the time of the
/// pixel's last event, of either polarity, that passed. A backward step ends the blindness.
struct RefractoryFilter {
  int64_t period = 1'000;  ///< microseconds, 1 to 1e9
};

using FilterParameters = std::variant<SupportFilter, RefractoryFilter>;

/// A filter, for people.
struct FilterInfo {
  std::string name;         ///< "support"
  std::string description;  ///< one line
  std::vector<ParameterInfo> parameters;
};

/// All filters, in the order of the alternatives of FilterParameters.
std::span<const FilterInfo> filters();

/// The entry of some parameters.
const FilterInfo& info_of(const FilterParameters& parameters);

/// Parameters from words: "support", "support:range=1,period=100ms". Times are whole numbers of microseconds,
/// or have a suffix us, ms or s. Errors: illegal_parameter, naming the filter and what is legal.
Result<FilterParameters> parse_filter(const std::string& words);

/// The parameters as they came. Errors: illegal_parameter if one is out of range.
Result<FilterParameters> checked_filter(const FilterParameters& parameters);

/// One filter and its state. Implementations agree event by event, for any stream and any way of cutting it
/// into batches. Events outside the sensor pass and leave no trace in the state. One thread at a time.
class EventFilter {
 public:
  virtual ~EventFilter() = default;

  virtual SensorSize sensor() const = 0;
  /// Appends the events that pass to `passing`, in their order, and returns how many these are. `events` must
  /// not lie in `passing`. Errors: refused_batch as Representation::push, out_of_memory; then nothing
  /// changed.
  virtual Result<size_t> filter(std::span<const Event> events, std::vector<Event>& passing) = 0;
  /// Events since construction or reset.
  virtual const FilterReport& report() const = 0;
  /// Forgets all events, and counts from 0.
  virtual Result<void> reset() = 0;
};

/// Filters behind each other: each sees what the one before it hands on. Without filters everything passes.
class FilterChain {
 public:
  FilterChain() = default;
  explicit FilterChain(std::vector<std::unique_ptr<EventFilter>> filters) : filters_(std::move(filters)) {}

  bool empty() const { return filters_.empty(); }
  /// Whether all filters have seen the same batches; see filter().
  bool complete() const { return !incomplete_; }
  /// The events that pass all filters; valid until the next call and as long as `events` are.
  /// Errors: as EventFilter::filter. If a filter behind the first fails, those in front of it have seen the
  /// batch: every later call says so, until reset.
  Result<std::span<const Event>> filter(std::span<const Event> events);
  /// In the order of the filters.
  std::vector<FilterReport> reports() const;
  Result<void> reset();

 private:
  std::vector<std::unique_ptr<EventFilter>> filters_;
  std::vector<Event> front_;
  std::vector<Event> back_;
  bool incomplete_ = false;
};

/// The definition of a filter, on the CPU (library scarf::cpu_ref). Errors: illegal_parameter as
/// checked_filter, and for a sensor outside 1..16,384 pixels per axis.
Result<std::unique_ptr<EventFilter>> make_reference_filter(const FilterParameters& parameters,
                                                           SensorSize sensor);

}  // namespace scarf
