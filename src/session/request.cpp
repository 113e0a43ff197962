#include "session/request.h"

#include <utility>

#include "core/text.h"
#include "scarf/reference/reference.h"

namespace scarf {
namespace {

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<Geometry> explicit_grid(const StreamRequest& o, SensorSize sensor) {
  if (o.ratio) return illegal("StreamRequest::ratio is not used by preset explicit; leave it out");
  if (o.alpha)
    return illegal(
        "StreamRequest::alpha is not used by preset explicit; leave it out and give StreamRequest::capacity");
  for (const auto& [name, given] : {std::pair{"StreamRequest::cell WxH", !o.cell.empty()},
                                    std::pair{"StreamRequest::origin X,Y", o.origin.has_value()},
                                    std::pair{"StreamRequest::grid WxH", o.grid.has_value()},
                                    std::pair{"StreamRequest::margin_lo X,Y", o.margin_lo.has_value()},
                                    std::pair{"StreamRequest::margin_hi X,Y", o.margin_hi.has_value()},
                                    std::pair{"StreamRequest::capacity N", o.capacity.has_value()}}) {
    if (!given) return illegal(text("preset explicit needs ", name));
  }
  const auto cell = parse_by(o.cell);
  if (!cell) return illegal(text("StreamRequest::cell ", cell.error().message));
  return checked_geometry(
      {.x = {sensor.width, cell->x, o.origin->x, o.grid->x, o.margin_lo->x, o.margin_hi->x},
       .y = {sensor.height, cell->y, o.origin->y, o.grid->y, o.margin_lo->y, o.margin_hi->y},
       .capacity = *o.capacity});
}

}  // namespace

Result<void> require_events(const std::string& path, const ReadReport& report, bool allow_empty) {
  if (report.events > 0 || allow_empty) return {};
  std::string met;
  const auto add = [&met](uint64_t count, std::string_view what) {
    if (count > 0) met += text(met.empty() ? " but " : ", ", count, " ", what);
  };
  add(report.outside, "events outside the sensor");
  add(report.dropped, "events older than one before them");
  add(report.undefined_polarities, "events of undefined polarity");
  add(report.unknown_words, "unknown words or lines");
  add(report.truncated_bytes, "bytes at the end that make no whole word, line or packet");
  add(report.damages, "damaged places");
  return Error{ErrorCode::bad_input, text(path == "-" ? "standard input" : path, ": not one event was read",
                                          met, "; if that is right, give StreamRequest::allow_empty")};
}

Result<Geometry> grid_on(const StreamRequest& o, SensorSize sensor) {
  const Preset preset = o.preset.value_or(Preset::paper);
  if (preset == Preset::explicit_) return explicit_grid(o, sensor);
  for (const auto& [name, given] : {std::pair{"StreamRequest::origin", o.origin.has_value()},
                                    std::pair{"StreamRequest::grid", o.grid.has_value()},
                                    std::pair{"StreamRequest::margin_lo", o.margin_lo.has_value()},
                                    std::pair{"StreamRequest::margin_hi", o.margin_hi.has_value()},
                                    std::pair{"StreamRequest::capacity", o.capacity.has_value()}}) {
    if (given)
      return illegal(text(name, " is used by preset explicit only; leave it out, or choose that preset"));
  }
  PresetParameters parameters{.cell = {}, .ratio = o.ratio, .alpha = o.alpha};
  if (!o.cell.empty()) {
    parameters.cell = parse_integer<int32_t>(o.cell);
    if (!parameters.cell) {
      return illegal(text("StreamRequest::cell is '", o.cell, "', but preset ", preset_name(preset),
                          " takes one whole number"));
    }
  }
  return make_geometry(preset, sensor, parameters);
}

Result<Geometry> scarf_grid(const StreamRequest& request, SensorSize sensor) {
  if (const auto r = parse_parameters("scarf", request.parameters); !r) return r.error();
  return grid_on(request, sensor);
}

Result<Parameters> parameters_of(const StreamRequest& o) {
  for (const auto& [name, given] :
       {std::pair{"preset", o.preset.has_value()}, std::pair{"cell", !o.cell.empty()},
        std::pair{"ratio", o.ratio.has_value()}, std::pair{"alpha", o.alpha.has_value()},
        std::pair{"origin", o.origin.has_value()}, std::pair{"grid", o.grid.has_value()},
        std::pair{"margin_lo", o.margin_lo.has_value()}, std::pair{"margin_hi", o.margin_hi.has_value()},
        std::pair{"capacity", o.capacity.has_value()}}) {
    if (!given) continue;
    return illegal(text("StreamRequest::", name, " is used by scarf only; leave it out with representation ",
                        o.representation));
  }
  return parse_parameters(o.representation, o.parameters);
}

Result<OpenRecording> open_recording(const StreamRequest& request) {
  auto source = open_events(request.file, request.read);
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, request.file);
  if (!sensor) return sensor.error();
  return OpenRecording{*std::move(source), *sensor};
}

namespace {

// What is asked for: a patch grid for SCARF, parameters for the others.
struct Wish {
  std::optional<Geometry> grid;
  Parameters parameters;
};

Result<Wish> wish_of(const StreamRequest& request, SensorSize sensor) {
  if (request.representation != "scarf") {
    const auto parameters = parameters_of(request);
    if (!parameters) return parameters.error();
    return Wish{std::nullopt, *parameters};
  }
  const auto grid = scarf_grid(request, sensor);
  if (!grid) return grid.error();
  return Wish{*grid, {}};
}

template <class Made>
Result<Implementation> implementation(Result<Made> made, const std::string& name) {
  if (!made) return made.error();
  return Implementation{*std::move(made), name};
}

}  // namespace

Result<Implementation> make_reference(const StreamRequest& request, SensorSize sensor) {
  const auto wish = wish_of(request, sensor);
  if (!wish) return wish.error();
  const std::string name = "CPU reference";
  auto made = wish->grid ? implementation(make_reference_scarf(*wish->grid, request.accumulation), name)
                         : implementation(make_reference_representation(wish->parameters, sensor), name);
  if (!made) return made;
  return implementation(behind_filters(std::move(made->representation), request.filters), name);
}

Result<Implementation> make_gpu(const StreamRequest& request, SensorSize sensor, const GpuOptions& gpu) {
  if (const auto wish = wish_of(request, sensor); !wish) return wish.error();  // before a device is woken
  const auto context = GpuContext::create(request.device);
  if (!context) return context.error();
  return make_gpu(*context, request, sensor, gpu);
}

Result<Implementation> make_gpu(const std::shared_ptr<GpuContext>& context, const StreamRequest& request,
                                SensorSize sensor, const GpuOptions& gpu) {
  const auto wish = wish_of(request, sensor);
  if (!wish) return wish.error();
  const std::string& name = context->device().name;
  if (wish->grid) {
    return implementation(make_gpu_scarf(context, *wish->grid, request.accumulation, gpu, request.filters),
                          name);
  }
  return implementation(make_gpu_representation(context, wish->parameters, sensor, gpu, request.filters),
                        name);
}

Result<std::string> filter_lines(const StreamRequest& request, Representation& representation) {
  const auto reports = representation.filter_reports().wait();
  if (!reports) return reports.error();
  std::string lines;
  for (size_t i = 0; i < reports->size(); ++i) {
    const FilterReport& r = (*reports)[i];
    lines += text("filter ", info_of(request.filters[i]).name, ": ", r.passed, " events passed, ", r.rejected,
                  " rejected\n");
  }
  return lines;
}

Result<Implementation> make_implementation(const StreamRequest& request, SensorSize sensor) {
  return request.cpu ? make_reference(request, sensor) : make_gpu(request, sensor);
}

}  // namespace scarf
