// The patch grid of SCARF: thirteen integers, and the named constructors that fill them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf {

inline constexpr int32_t kMaxSensorSize = 16'384;  ///< pixels per axis
inline constexpr int32_t kMaxField = 128;  ///< pixels per axis of a receptive field: 7-bit local coordinates
inline constexpr int32_t kMaxCapacity = 65'535;  ///< slots of one ring buffer

/// Patches first..last (inclusive); empty if last < first.
struct PatchRange {
  int32_t first = 0;
  int32_t last = -1;
  friend bool operator==(const PatchRange&, const PatchRange&) = default;
};

/// One axis of a patch grid. Patch i is active on [origin + i*cell, origin + (i+1)*cell), and its receptive
/// field is that range widened by margin_lo below and margin_hi above; both are clipped to the sensor.
struct GridAxis {
  int32_t size = 0;       ///< sensor pixels
  int32_t cell = 0;       ///< pixels of an active region
  int32_t origin = 0;     ///< first pixel of the active region of patch 0; may lie outside the sensor
  int32_t grid = 0;       ///< number of patches
  int32_t margin_lo = 0;  ///< pixels of the field before the active region
  int32_t margin_hi = 0;  ///< pixels of the field behind it

  /// Size of a receptive field in pixels, before clipping to the sensor.
  int32_t field() const { return margin_lo + cell + margin_hi; }
  /// First pixel of the unclipped field of patch i: the origin of patch-local coordinates.
  int32_t field_begin(int32_t i) const { return origin + i * cell - margin_lo; }
  /// The patches whose field holds pixel v (0 <= v < size).
  PatchRange patches_holding(int32_t v) const;
  /// Whether pixel v lies in the active region of patch i.
  bool active(int32_t v, int32_t i) const { return v >= origin + i * cell && v < origin + (i + 1) * cell; }

  friend bool operator==(const GridAxis&, const GridAxis&) = default;
};

/// A patch grid on a sensor. Patch (i,j) has the id j * x.grid + i.
struct Geometry {
  GridAxis x;
  GridAxis y;
  int32_t capacity = 0;  ///< N: slots of each patch's ring buffer

  SensorSize sensor() const { return {x.size, y.size}; }
  /// Number of patches.
  int64_t patches() const { return int64_t{x.grid} * y.grid; }

  friend bool operator==(const Geometry&, const Geometry&) = default;
};

enum class Preset {
  paper,              ///< the supplement's geometry, full coverage; the default
  light,              ///< the paper's "typically 4 buffers per event"
  event_driven,       ///< what robotology/event-driven (main) does
  event_driven_flex,  ///< the ablation branch of the same
  explicit_,          ///< any thirteen integers, given by the caller
};

/// Parameters of a preset; what is not given takes the default. A parameter that the preset does not use is
/// refused if given.
struct PresetParameters {
  std::optional<int32_t> cell = {};  ///< k, pixels, >= 1; default 9
  std::optional<double> ratio = {};  ///< r, reach of the field in cells, >= 0; default 1.2
  std::optional<double> alpha = {};  ///< scale of the capacity, > 0; default 2.0
};

inline constexpr double kDefaultAccumulation = 0.3;  ///< c: brightness of one event in a dense image

/// The grid of a preset on a sensor. Errors: illegal_parameter, naming the parameter, the value and the legal
/// range; a sensor too small for the preset names the smallest size. Preset::explicit_ is not accepted here.
Result<Geometry> make_geometry(Preset preset, SensorSize sensor, const PresetParameters& parameters = {});

/// Checks thirteen integers given by the caller, and returns them.
/// Legal: sensor 1..16,384 per axis; cell >= 1; grid >= 1; margins >= 0; field <= 128 per axis; capacity
/// 1..65,535; the active region of patch 0 begins, and that of the last patch ends, within 16,384 pixels of
/// the sensor.
Result<Geometry> checked_geometry(const Geometry& geometry);

/// "paper", "light", ... and back; an unknown name is an error that lists the names.
std::string_view preset_name(Preset preset);
Result<Preset> preset_from_name(std::string_view name);

/// One line for logs and file headers: the thirteen integers with their names.
std::string to_string(const Geometry& geometry);

}  // namespace scarf
