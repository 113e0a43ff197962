// Every representation by name: its parameters, their defaults and legal ranges, and how to make it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scarf/core/image.h"
#include "scarf/core/patch_grid.h"
#include "scarf/core/result.h"

namespace scarf {

/// SCARF, see scarf/core/patch_state.h.
struct ScarfParameters {
  Preset preset = Preset::paper;
  PresetParameters grid = {};
  double accumulation = kDefaultAccumulation;  ///< brightness of one event
};

/// Pixels that fired within the window.
struct TimeWindowParameters {
  int64_t window = 33'000;  ///< w, microseconds, 1 to 1e8
  /// false: 1 where last > T - w. true: the number of events with t > t_max - w, where t_max is the largest
  /// time since reset; brightness as SCARF's counts.
  bool counts = false;
  double accumulation = kDefaultAccumulation;  ///< brightness of one event, with `counts`
};

/// Surface of active events, also called time surface.
struct SaeParameters {
  enum class Decay { exponential, linear } decay = Decay::exponential;
  int64_t tau = 33'000;  ///< microseconds, 1 to 1e7: time constant, or length of the linear ramp
};

/// Exponential reduced ordinal surface.
struct ErosParameters {
  int32_t kernel = 9;  ///< k, odd 3 to 63; an even value is raised by 1
  double decay = 0.3;  ///< d, 0 < d < 1; each event in a pixel's window scales it by d^(1/k)
};

/// Threshold ordinal surface.
struct TosParameters {
  int32_t kernel = 9;  ///< as ErosParameters
  double decay = 2;    ///< values below 255 - kernel * decay become 0; 0 < kernel * decay < 255
};

/// Speed invariant time surface.
struct SitsParameters {
  enum class Rule { paper, greater, event_driven } rule = Rule::paper;
  int32_t kernel = 9;  ///< as ErosParameters
};

/// Chained surface: pixels by the order in which they last fired.
struct ChainSaeParameters {
  enum class Rule { paper, event_driven } rule = Rule::paper;
  bool linear = false;  ///< 1 - i/(W*H) instead of its 10th power
};

/// Adaptive surface with a decay from the density of the events.
struct AedSaeParameters {
  int64_t window = 300'000;  ///< dT, microseconds, 1,000 to 1e8
  double lambda = 0.3;       ///< > 0, finite
};

/// Adaptive accumulation: as many of the newest events per block as its activity asks for.
struct AaeParameters {
  int32_t block = 15;  ///< pixels, 1 to 1024
  bool keep = false;   ///< a query leaves the queues as they are
  bool esvo2 = false;  ///< the variant of ESVO2: 8 x 6 blocks, events since the last query
};

using Parameters =
    std::variant<ScarfParameters, TimeWindowParameters, SaeParameters, ErosParameters, TosParameters,
                 SitsParameters, ChainSaeParameters, AedSaeParameters, AaeParameters>;

/// One parameter, for people and command lines.
struct ParameterInfo {
  std::string name;         ///< "kernel"
  std::string value;        ///< the default as parse_parameters reads it: "9"
  std::string range;        ///< "odd, 3 to 63"
  std::string description;  ///< one line
};

/// A representation, for people and for code that runs all of them.
struct RepresentationInfo {
  std::string name;         ///< "eros"
  std::string title;        ///< "EROS"
  std::string description;  ///< one line
  std::vector<ParameterInfo> parameters;
  bool exact = true;        ///< GPU and reference agree bit for bit; else within a bound
  bool has_events = false;  ///< Representation::events() works (with some parameters)
};

/// All representations, scarf first. In the order of the alternatives of Parameters.
std::span<const RepresentationInfo> representations();

/// The entry of some parameters.
const RepresentationInfo& info_of(const Parameters& parameters);

/// Whether a query changes what later queries show.
bool query_changes_state(const Parameters& parameters);

/// Parameters from words: name -> value. Errors: illegal_parameter, naming the representation and what is
/// legal, for unknown names, unreadable values and values out of range.
Result<Parameters> parse_parameters(const std::string& representation,
                                    const std::map<std::string, std::string>& words = {});

/// The parameters, with even kernels raised by 1. Errors: illegal_parameter as above. Geometry is checked
/// when the sensor is known.
Result<Parameters> checked_parameters(Parameters parameters);

}  // namespace scarf
