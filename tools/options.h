// Options that render, digest and verify share: the recording, the representation, the device.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarf/filter.h"
#include "scarf/geometry.h"
#include "scarf/gpu.h"
#include "scarf/io.h"
#include "tools/batch_sizes.h"
#include "tools/file_options.h"
#include "tools/parse.h"

namespace scarf::tools {

struct StreamOptions {
  std::string file;
  ReadOptions read;          ///< how the recording is read
  bool allow_empty = false;  ///< a recording without an event is no failure

  std::string representation = "scarf";
  std::map<std::string, std::string> parameters;  ///< of the representation, as parse_parameters takes them
  std::vector<FilterParameters> filters;          ///< in front of the representation
  std::vector<const CLI::Option*> grid_options;   ///< for SCARF only

  Preset preset = Preset::paper;
  std::string cell;  ///< K, or WxH with preset explicit; empty: the default
  std::optional<double> ratio;
  std::optional<double> alpha;
  double accumulation = kDefaultAccumulation;
  std::optional<Pair> origin, grid, margin_lo, margin_hi;  ///< with preset explicit only
  std::optional<int32_t> capacity;                         ///< with preset explicit only

  BatchSizes batches = BatchSizes::fixed(kDefaultBatch);
  DeviceOptions device;
  bool cpu = false;  ///< the CPU reference instead of a device
};

/// Adds an option whose word is read by `parse`; its error becomes the parser's.
template <class T, class Target>
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, Target& target,
                               Result<T> (*parse)(const std::string&), const std::string& help) {
  // CLI11 runs the check before the callback, so the word is known to be good there.
  return app
      .add_option_function<std::string>(
          name, [&target, parse](const std::string& word) { target = *parse(word); }, help)
      ->type_name(kWordType)
      ->check([parse](const std::string& word) {
        const auto value = parse(word);
        return value ? std::string() : value.error().message;
      });
}

/// The recording, the representation and its parameters, the batches and the device: all of the below.
/// `more`: further names that the option --representation takes.
void add_stream_options(CLI::App& app, StreamOptions& options, const std::vector<std::string>& more = {});
/// The representation, its parameters, and the filters in front.
void add_representation_options(CLI::App& app, StreamOptions& options,
                                const std::vector<std::string>& more = {});
/// The batches and who does the work.
void add_work_options(CLI::App& app, StreamOptions& options);
/// Each of representations(), with its defaults.
inline const std::string kAllRepresentations = "all";

/// The patch grid that the options ask for on a sensor.
/// Errors: illegal_parameter, naming the option that is missing, wrong or not used by the preset.
Result<Geometry> grid_on(const StreamOptions& options, SensorSize sensor);

/// The same, where the representation is SCARF. Errors: also for parameters that SCARF does not have.
Result<Geometry> scarf_grid(const StreamOptions& options, SensorSize sensor);

/// The parameters of a representation other than SCARF. Errors: illegal_parameter, also for options that only
/// SCARF has.
Result<Parameters> parameters_of(const StreamOptions& options);

/// A recording and the size of its sensor.
struct OpenRecording {
  std::unique_ptr<EventSource> source;
  SensorSize sensor;
};
Result<OpenRecording> open_recording(const StreamOptions& options);

/// A representation and the name to show for who computes it.
struct Implementation {
  std::unique_ptr<Representation> representation;
  std::string name;
};
Result<Implementation> make_reference(const StreamOptions& options, SensorSize sensor);
Result<Implementation> make_gpu(const StreamOptions& options, SensorSize sensor, const GpuOptions& gpu = {});
/// On a device that is in use already, and that other streams may share.
Result<Implementation> make_gpu(const std::shared_ptr<GpuContext>& context, const StreamOptions& options,
                                SensorSize sensor, const GpuOptions& gpu = {});
/// One line for each noise filter: what became of the events. Errors: whatever the representation returned.
Result<std::string> filter_lines(const StreamOptions& options, Representation& representation);
/// The one that the options choose.
Result<Implementation> make_implementation(const StreamOptions& options, SensorSize sensor);

}  // namespace scarf::tools
