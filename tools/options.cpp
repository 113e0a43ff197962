#include "tools/options.h"

#include <utility>

#include "core/text.h"
#include "scarf/reference.h"

namespace scarf::tools {
namespace {

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<Preset> parse_preset(const std::string& word) {
  return preset_from_name(word);
}

Result<Geometry> explicit_grid(const StreamOptions& o, SensorSize sensor) {
  if (o.ratio) return illegal("--ratio is not used by preset explicit; leave it out");
  if (o.alpha) return illegal("--alpha is not used by preset explicit; leave it out and give --capacity");
  for (const auto& [name, given] :
       {std::pair{"--cell WxH", !o.cell.empty()}, std::pair{"--origin X,Y", o.origin.has_value()},
        std::pair{"--grid WxH", o.grid.has_value()}, std::pair{"--margin-lo X,Y", o.margin_lo.has_value()},
        std::pair{"--margin-hi X,Y", o.margin_hi.has_value()},
        std::pair{"--capacity N", o.capacity.has_value()}}) {
    if (!given) return illegal(text("preset explicit needs ", name));
  }
  const auto cell = parse_by(o.cell);
  if (!cell) return illegal(text("--cell ", cell.error().message));
  return checked_geometry(
      {.x = {sensor.width, cell->x, o.origin->x, o.grid->x, o.margin_lo->x, o.margin_hi->x},
       .y = {sensor.height, cell->y, o.origin->y, o.grid->y, o.margin_lo->y, o.margin_hi->y},
       .capacity = *o.capacity});
}

}  // namespace

void add_stream_options(CLI::App& app, StreamOptions& o) {
  app.add_option("file", o.file, "Recording; - is standard input")->required();
  add_parsed_option(app, "--geometry", o.sensor, parse_sensor,
                    "Sensor size WxH, where the recording does not say");

  const std::string grid = "Patch grid";
  add_parsed_option(app, "--preset", o.preset, parse_preset,
                    "paper (default), light, event_driven, event_driven_flex or explicit")
      ->group(grid);
  app.add_option("--cell", o.cell, "Pixels of a cell, default 9; WxH with preset explicit")->group(grid);
  app.add_option("--ratio", o.ratio, "Receptive field ratio, default 1.2; paper and event_driven_flex only")
      ->group(grid);
  app.add_option("--alpha", o.alpha, "Scale of the capacity, default 2.0")->group(grid);
  app.add_option("--accumulation", o.accumulation, "Brightness of one event, default 0.3")->group(grid);
  const std::string with_explicit = "Patch grid, preset explicit";
  add_parsed_option(app, "--origin", o.origin, parse_comma, "X,Y: first pixel of the first cell")
      ->group(with_explicit);
  add_parsed_option(app, "--grid", o.grid, parse_by, "WxH: number of patches")->group(with_explicit);
  add_parsed_option(app, "--margin-lo", o.margin_lo, parse_comma, "X,Y: field before the cell")
      ->group(with_explicit);
  add_parsed_option(app, "--margin-hi", o.margin_hi, parse_comma, "X,Y: field behind the cell")
      ->group(with_explicit);
  add_parsed_option(app, "--capacity", o.capacity, parse_whole<int32_t>, "Events that a patch holds")
      ->group(with_explicit);

  const std::string work = "Work";
  add_parsed_option(app, "--batch", o.batches, parse_batch_sizes,
                    "Events per batch: N, random or random:SEED; never changes a result")
      ->group(work);
  CLI::Option* device =
      app.add_option("--device", o.device.device, "Index, part of the name, UUID or type of the device")
          ->group(work);
  CLI::Option* require_gpu =
      app.add_flag("--require-gpu", o.device.require_gpu, "Refuse Vulkan devices that are CPUs")->group(work);
  app.add_flag("--cpu", o.cpu, "The CPU reference, no Vulkan")
      ->group(work)
      ->excludes(device)
      ->excludes(require_gpu);
}

Result<Geometry> grid_on(const StreamOptions& o, SensorSize sensor) {
  if (o.preset == Preset::explicit_) return explicit_grid(o, sensor);
  for (const auto& [name, given] :
       {std::pair{"--origin", o.origin.has_value()}, std::pair{"--grid", o.grid.has_value()},
        std::pair{"--margin-lo", o.margin_lo.has_value()}, std::pair{"--margin-hi", o.margin_hi.has_value()},
        std::pair{"--capacity", o.capacity.has_value()}}) {
    if (given)
      return illegal(text(name, " is used by --preset explicit only; leave it out, or choose that preset"));
  }
  PresetParameters parameters{.cell = {}, .ratio = o.ratio, .alpha = o.alpha};
  if (!o.cell.empty()) {
    parameters.cell = parse_integer<int32_t>(o.cell);
    if (!parameters.cell) {
      return illegal(
          text("--cell is '", o.cell, "', but preset ", preset_name(o.preset), " takes one whole number"));
    }
  }
  return make_geometry(o.preset, sensor, parameters);
}

Result<OpenRecording> open_recording(const StreamOptions& options) {
  auto source = open_events(options.file, {.sensor = options.sensor});
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  const auto geometry = grid_on(options, *sensor);
  if (!geometry) return geometry.error();
  return OpenRecording{*std::move(source), *geometry};
}

Result<Implementation> make_reference(const StreamOptions& options, const Geometry& geometry) {
  auto scarf = make_reference_scarf(geometry, options.accumulation);
  if (!scarf) return scarf.error();
  return Implementation{*std::move(scarf), "CPU reference"};
}

Result<Implementation> make_gpu(const StreamOptions& options, const Geometry& geometry) {
  const auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  auto scarf = make_gpu_scarf(*context, geometry, options.accumulation);
  if (!scarf) return scarf.error();
  return Implementation{*std::move(scarf), (*context)->device().name};
}

Result<Implementation> make_implementation(const StreamOptions& options, const Geometry& geometry) {
  return options.cpu ? make_reference(options, geometry) : make_gpu(options, geometry);
}

}  // namespace scarf::tools
