// Encodings: tensors for networks and classifiers, made of sparse events such as Representation::events().
// Exact definitions: docs/ENCODINGS.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/image.h"
#include "scarf/core/parameters.h"
#include "scarf/core/result.h"

namespace scarf {

/// Voxel grid: time in bins, each event split linearly over two of them.
struct VoxelGridParameters {
  int32_t bins = 5;  ///< B, 1 to 256
  /// e2vid: B planes, ON adds and OFF subtracts. eventgan: 2B planes, those of ON, then those of OFF, both
  /// of which add.
  enum class Convention { e2vid, eventgan } convention = Convention::e2vid;
};

/// Time-ordered recent events: the k newest ages of each pixel and polarity, as logarithms.
/// 2k planes: ON newest to oldest, then OFF.
struct ToreParameters {
  int32_t k = 8;  ///< 1 to 64
};

/// Event image of EV-FlowNet. 4 planes: number of ON and of OFF events, last time of ON and of OFF events,
/// 0 = first event of all, 1 = last event of all.
struct EventImageParameters {};

/// Time surface: exp(-age / tau) of the last event of each pixel and polarity. 2 planes: ON, OFF.
struct TimeSurfaceParameters {
  int64_t tau = 33'000;  ///< microseconds, 1 to 1e9
};

/// Histograms of averaged time surfaces. One pixel per cell, 2 * (2 * radius + 1)^2 planes: polarity (ON,
/// OFF), then row and column of the neighbour.
struct HatsParameters {
  int32_t cell = 10;         ///< pixels, 1 to 16,384
  int32_t radius = 3;        ///< pixels, 0 to 16
  int64_t tau = 1'000'000;   ///< microseconds, 1 to 1e9
  int64_t window = 100'000;  ///< dT, microseconds: older events are forgotten; 1 to 1e9
};

/// Time surfaces of HOTS (its first layer), averaged over the events of a cell. Shape as HATS, with the
/// polarity of the neighbour.
struct HotsParameters {
  int32_t cell = 10;     ///< pixels, 1 to 16,384
  int32_t radius = 2;    ///< pixels, 0 to 16
  int64_t tau = 50'000;  ///< microseconds, 1 to 1e9
};

using EncodingParameters = std::variant<VoxelGridParameters, ToreParameters, EventImageParameters,
                                        TimeSurfaceParameters, HatsParameters, HotsParameters>;

/// An encoding, for people and for code that runs all of them.
struct EncodingInfo {
  std::string name;         ///< "voxel_grid"
  std::string title;        ///< "VoxelGrid"
  std::string description;  ///< one line
  std::vector<ParameterInfo> parameters;
  bool cpu_only = false;  ///< no implementation but the reference
};

/// All encodings, in the order of the alternatives of EncodingParameters.
std::span<const EncodingInfo> encodings();

/// The entry of some parameters.
const EncodingInfo& info_of(const EncodingParameters& parameters);

/// Parameters from words: "tore", "voxel_grid:bins=5,convention=e2vid". Times are whole numbers of
/// microseconds, or have a suffix us, ms or s. Errors: illegal_parameter, naming the encoding and what is
/// legal.
Result<EncodingParameters> parse_encoding(const std::string& words);

/// The parameters as they came. Errors: illegal_parameter if one is out of range.
Result<EncodingParameters> checked_encoding(const EncodingParameters& parameters);

/// Shape of an encoding of legal parameters.
struct EncodingShape {
  int32_t planes = 0;
  int32_t height = 0;
  int32_t width = 0;
  friend bool operator==(const EncodingShape&, const EncodingShape&) = default;
};
EncodingShape shape_of(const EncodingParameters& parameters, SensorSize sensor);

/// The definition of an encoding, on the CPU (library scarf::cpu_ref). The events may come in any order: the
/// result is the same, bit for bit. Those outside the sensor are ignored. Errors: illegal_parameter as
/// checked_encoding, and for a sensor outside 1..16,384 pixels per axis; refused_batch, naming the event, if
/// one inside the sensor has p > 1.
Result<Image<float>> encode(const EncodingParameters& parameters, SensorSize sensor,
                            std::span<const Event> events);

}  // namespace scarf
