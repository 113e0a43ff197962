// What is asked for: a recording, a representation of it, and who computes it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parse.h"
#include "scarf/core/filter.h"
#include "scarf/core/patch_grid.h"
#include "scarf/device/stream.h"
#include "scarf/io/recordings.h"
#include "session/batch_sizes.h"
#include "session/settings.h"

namespace scarf {

/// A recording played through a representation. Nothing is set but what has a default: what only SCARF or
/// only one preset takes is an error where it is set for another.
struct StreamRequest {
  std::string file;          ///< "-" is standard input
  ReadOptions read;          ///< how the recording is read
  bool allow_empty = false;  ///< a recording without an event is no failure

  std::string representation = "scarf";
  std::map<std::string, std::string> parameters;  ///< of the representation, as parse_parameters takes them
  std::vector<FilterParameters> filters;          ///< in front of the representation

  std::optional<Preset> preset;  ///< of SCARF's patch grid; without it paper
  std::string cell;              ///< K, or WxH with preset explicit; empty: the default
  std::optional<double> ratio;
  std::optional<double> alpha;
  double accumulation = kDefaultAccumulation;
  std::optional<Pair> origin, grid, margin_lo, margin_hi;  ///< with preset explicit only
  std::optional<int32_t> capacity;                         ///< with preset explicit only

  BatchSizes batches = BatchSizes::fixed(kDefaultBatch);
  DeviceOptions device;
  bool cpu = false;  ///< the CPU reference instead of a device
};

// The settings by which words fill in a request, which outlives them.

/// How a recording is read.
Settings read_settings(ReadOptions& options);
/// StreamRequest::allow_empty.
Settings empty_settings(bool& allow_empty);
/// The representation, its parameters, and the filters in front. `more`: further names of representations.
Settings representation_settings(StreamRequest& request, const std::vector<std::string>& more = {});
/// The parameters of some representations by name, each once, whoever has it; all but `without`.
Settings parameter_settings(std::map<std::string, std::string>& words,
                            std::span<const RepresentationInfo> owners, std::string_view without = {});
/// The batches and who does the work.
Settings work_settings(StreamRequest& request);
/// All of the above.
Settings stream_settings(StreamRequest& request, const std::vector<std::string>& more = {});

/// A job whose recording gave not one event has failed, unless that is allowed. Errors: bad_input, saying
/// what the reader met instead.
Result<void> require_events(const std::string& path, const ReadReport& report, bool allow_empty);

/// The patch grid that the request asks for on a sensor.
/// Errors: illegal_parameter, naming what is missing, wrong or not used by the preset.
Result<Geometry> grid_on(const StreamRequest& request, SensorSize sensor);

/// The same, where the representation is SCARF. Errors: also for parameters that SCARF does not have.
Result<Geometry> scarf_grid(const StreamRequest& request, SensorSize sensor);

/// The parameters of a representation other than SCARF. Errors: illegal_parameter, also for what only SCARF
/// has.
Result<Parameters> parameters_of(const StreamRequest& request);

/// A recording and the size of its sensor.
struct OpenRecording {
  std::unique_ptr<EventSource> source;
  SensorSize sensor;
};
Result<OpenRecording> open_recording(const StreamRequest& request);

/// A representation and the name to show for who computes it.
struct Implementation {
  std::unique_ptr<Representation> representation;
  std::string name;
};
Result<Implementation> make_reference(const StreamRequest& request, SensorSize sensor);
Result<Implementation> make_gpu(const StreamRequest& request, SensorSize sensor, const GpuOptions& gpu = {});
/// On a device that is in use already, and that other streams may share.
Result<Implementation> make_gpu(const std::shared_ptr<GpuContext>& context, const StreamRequest& request,
                                SensorSize sensor, const GpuOptions& gpu = {});
/// The one that the request chooses.
Result<Implementation> make_implementation(const StreamRequest& request, SensorSize sensor);

/// One line for each noise filter: what became of the events. Errors: whatever the representation returned.
Result<std::string> filter_lines(const StreamRequest& request, Representation& representation);

}  // namespace scarf
