#include "tools/options.h"

#include <utility>

#include "core/text.h"
#include "scarf/reference.h"
#include "tools/read_options.h"

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

// Parameters of the registry become options of the same name, each once, whoever has it.
void add_parameter_options(CLI::App& app, StreamOptions& o) {
  struct Shared {
    std::string description;
    std::string owners;
  };
  std::map<std::string, Shared> shared;
  for (const RepresentationInfo& info : representations().subspan(1)) {
    for (const ParameterInfo& p : info.parameters) {
      Shared& s = shared[p.name];
      s.owners += text(s.owners.empty() ? "" : "; ", info.name, ": ", p.range, ", default ", p.value);
      if (s.description.empty()) s.description = p.description;
    }
  }
  for (const auto& [name, s] : shared) {
    if (name == "accumulation") continue;  // SCARF's option serves
    app.add_option_function<std::string>(
           "--" + name, [&o, key = name](const std::string& word) { o.parameters[key] = word; },
           text(s.description, " (", s.owners, ")"))
        ->type_name(kWordType)
        ->group("Other representations");
  }
}

}  // namespace

void add_representation_options(CLI::App& app, StreamOptions& o, const std::vector<std::string>& more) {
  std::vector<std::string> names = more;
  for (const RepresentationInfo& info : representations()) names.push_back(info.name);
  app.add_option("--representation", o.representation, "Which picture; see scarf representations")
      ->check(CLI::IsMember(names));
  const auto only_scarf = [&o](CLI::Option* option, const std::string& group) {
    o.grid_options.push_back(option->group(group));
  };
  const std::string grid = "Patch grid of scarf";
  only_scarf(add_parsed_option(app, "--preset", o.preset, parse_preset,
                               "paper (default), light, event_driven, event_driven_flex or explicit"),
             grid);
  only_scarf(add_word_option(app, "--cell", o.cell, "Pixels of a cell, default 9; WxH with preset explicit"),
             grid);
  only_scarf(add_parsed_option(app, "--ratio", o.ratio, parse_number,
                               "Receptive field ratio, default 1.2; paper and event_driven_flex only"),
             grid);
  only_scarf(add_parsed_option(app, "--alpha", o.alpha, parse_number, "Scale of the capacity, default 2.0"),
             grid);
  const std::string with_explicit = "Patch grid of scarf, preset explicit";
  only_scarf(add_parsed_option(app, "--origin", o.origin, parse_comma, "X,Y: first pixel of the first cell"),
             with_explicit);
  only_scarf(add_parsed_option(app, "--grid", o.grid, parse_by, "WxH: number of patches"), with_explicit);
  only_scarf(add_parsed_option(app, "--margin-lo", o.margin_lo, parse_comma, "X,Y: field before the cell"),
             with_explicit);
  only_scarf(add_parsed_option(app, "--margin-hi", o.margin_hi, parse_comma, "X,Y: field behind the cell"),
             with_explicit);
  only_scarf(
      add_parsed_option(app, "--capacity", o.capacity, parse_whole<int32_t>, "Events that a patch holds"),
      with_explicit);
  add_parsed_option(app, "--accumulation", o.accumulation, parse_number,
                    "Brightness of one event, default 0.3 (scarf; time_window with --counts)")
      ->each([&o](const std::string& word) { o.parameters["accumulation"] = word; });
  add_parameter_options(app, o);
  app.add_option_function<std::vector<std::string>>(
         "--filter",
         [&o](const std::vector<std::string>& words) {
           o.filters.clear();
           for (const std::string& word : words) o.filters.push_back(*parse_filter(word));
         },
         "A noise filter in front, support:range=1,period=100ms or refractory:period=1ms; may be repeated")
      ->type_name(kWordType)
      ->check([](const std::string& word) {
        const auto filter = parse_filter(word);
        return filter ? std::string() : filter.error().message;
      })
      ->group("Noise filters");
}

void add_stream_options(CLI::App& app, StreamOptions& o, const std::vector<std::string>& more) {
  add_input_option(app, "file", o.file, "Recording; - is standard input")->required();
  add_read_options(app, o.read);
  add_allow_empty(app, o.allow_empty);
  add_representation_options(app, o, more);
  add_work_options(app, o);
}

void add_work_options(CLI::App& app, StreamOptions& o) {
  const std::string work = "Work";
  add_parsed_option(app, "--batch", o.batches, parse_batch_sizes,
                    "Events per batch: N, random or random:SEED; never changes a result")
      ->group(work);
  CLI::Option* device =
      add_word_option(app, "--device", o.device.device, "Index, part of the name, UUID or type of the device")
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

Result<Geometry> scarf_grid(const StreamOptions& options, SensorSize sensor) {
  if (const auto r = parse_parameters("scarf", options.parameters); !r) return r.error();
  return grid_on(options, sensor);
}

Result<Parameters> parameters_of(const StreamOptions& o) {
  for (const CLI::Option* option : o.grid_options) {
    if (option->count() == 0) continue;
    return illegal(text(option->get_name(), " is used by scarf only; leave it out with --representation ",
                        o.representation));
  }
  return parse_parameters(o.representation, o.parameters);
}

Result<OpenRecording> open_recording(const StreamOptions& options) {
  auto source = open_events(options.file, options.read);
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  return OpenRecording{*std::move(source), *sensor};
}

namespace {

// What the options ask for: a patch grid for SCARF, parameters for the others.
struct Wish {
  std::optional<Geometry> grid;
  Parameters parameters;
};

Result<Wish> wish_of(const StreamOptions& options, SensorSize sensor) {
  if (options.representation != "scarf") {
    const auto parameters = parameters_of(options);
    if (!parameters) return parameters.error();
    return Wish{std::nullopt, *parameters};
  }
  const auto grid = scarf_grid(options, sensor);
  if (!grid) return grid.error();
  return Wish{*grid, {}};
}

template <class Made>
Result<Implementation> implementation(Result<Made> made, const std::string& name) {
  if (!made) return made.error();
  return Implementation{*std::move(made), name};
}

}  // namespace

Result<Implementation> make_reference(const StreamOptions& options, SensorSize sensor) {
  const auto wish = wish_of(options, sensor);
  if (!wish) return wish.error();
  const std::string name = "CPU reference";
  auto made = wish->grid ? implementation(make_reference_scarf(*wish->grid, options.accumulation), name)
                         : implementation(make_reference_representation(wish->parameters, sensor), name);
  if (!made) return made;
  return implementation(behind_filters(std::move(made->representation), options.filters), name);
}

Result<Implementation> make_gpu(const StreamOptions& options, SensorSize sensor, const GpuOptions& gpu) {
  if (const auto wish = wish_of(options, sensor); !wish) return wish.error();  // before a device is woken
  const auto context = GpuContext::create(options.device);
  if (!context) return context.error();
  return make_gpu(*context, options, sensor, gpu);
}

Result<Implementation> make_gpu(const std::shared_ptr<GpuContext>& context, const StreamOptions& options,
                                SensorSize sensor, const GpuOptions& gpu) {
  const auto wish = wish_of(options, sensor);
  if (!wish) return wish.error();
  const std::string& name = context->device().name;
  if (wish->grid) {
    return implementation(make_gpu_scarf(context, *wish->grid, options.accumulation, gpu, options.filters),
                          name);
  }
  return implementation(make_gpu_representation(context, wish->parameters, sensor, gpu, options.filters),
                        name);
}

Result<std::string> filter_lines(const StreamOptions& options, Representation& representation) {
  const auto reports = representation.filter_reports().wait();
  if (!reports) return reports.error();
  std::string lines;
  for (size_t i = 0; i < reports->size(); ++i) {
    const FilterReport& r = (*reports)[i];
    lines += text("filter ", info_of(options.filters[i]).name, ": ", r.passed, " events passed, ", r.rejected,
                  " rejected\n");
  }
  return lines;
}

Result<Implementation> make_implementation(const StreamOptions& options, SensorSize sensor) {
  return options.cpu ? make_reference(options, sensor) : make_gpu(options, sensor);
}

}  // namespace scarf::tools
