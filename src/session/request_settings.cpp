// The settings of a StreamRequest.
#include <utility>

#include "core/text.h"
#include "session/request.h"

namespace scarf {
namespace {

using Kind = Setting::Kind;

Result<Preset> parse_preset(const std::string& word) {
  return preset_from_name(word);
}

}  // namespace

Settings read_settings(ReadOptions& o) {
  const std::string reading = "Reading";
  Settings settings("ReadOptions");
  settings
      .add_parsed("geometry", o.sensor, parse_sensor, "Sensor size WxH, where the recording does not say",
                  "sensor")
      .in(reading);
  settings
      .add_text(Kind::word, "format", o.format,
                "Format, where the content does not tell; formats() lists them")
      .in(reading);
  settings.add_text(Kind::word, "stream", o.stream, "Which camera, of a recording with several").in(reading);
  settings
      .add_choice<TimePolicy>("time-policy", o.time_policy,
                              {{"keep", TimePolicy::keep},
                               {"clamp", TimePolicy::clamp},
                               {"drop", TimePolicy::drop},
                               {"error", TimePolicy::error}},
                              "Events older than one before them; clamp gives them the newest time")
      .in(reading);
  settings
      .add_choice<OutOfSensor>("out-of-sensor", o.out_of_sensor,
                               {{"drop", OutOfSensor::drop}, {"error", OutOfSensor::error}},
                               "Events outside the sensor")
      .in(reading);
  settings
      .add_choice<TimeShift>("time-shift", o.time_shift,
                             {{"none", TimeShift::none},
                              {"first-high", TimeShift::first_high},
                              {"first-event", TimeShift::first_event}},
                             "What is subtracted from all times")
      .in(reading);
  settings.add_flag("strict", o.strict, "Damage, unknown words and truncated bytes are errors").in(reading);
  settings
      .add_text(Kind::word, "columns", o.columns,
                "Order of the columns of text and plain arrays, such as txyp; or names of columns, such as "
                "t=/a/ts,x=/a/xs,y=/a/ys,p=/a/pol (HDF5, NumPy)")
      .in(reading);
  settings.add_text(Kind::word, "time-unit", o.time_unit, "Unit of times where the format leaves it open")
      .in(reading)
      .one_of({"s", "ms", "us", "ns"});
  settings.add_text(Kind::word, "yarp-time", o.yarp_time, "YARP packets without times of events")
      .in(reading)
      .one_of({"packet", "spread"});
  return settings;
}

Settings empty_settings(bool& allow_empty) {
  Settings settings("StreamRequest");
  settings.add_flag("allow-empty", allow_empty, "A recording without an event is no failure").in("Reading");
  return settings;
}

Settings parameter_settings(std::map<std::string, std::string>& words,
                            std::span<const RepresentationInfo> owners, std::string_view without) {
  Settings settings("StreamRequest");
  struct Shared {
    std::string description;
    std::string owners;
  };
  std::map<std::string, Shared> shared;
  for (const RepresentationInfo& info : owners) {
    for (const ParameterInfo& p : info.parameters) {
      Shared& s = shared[p.name];
      s.owners += text(s.owners.empty() ? "" : "; ", info.name, ": ", p.range, ", default ", p.value);
      if (s.description.empty()) s.description = p.description;
    }
  }
  for (const auto& [name, s] : shared) {
    if (name == without) continue;
    settings
        .add(Kind::word, name, text(s.description, " (", s.owners, ")"),
             [&words, key = name](const std::string& word) -> Result<void> {
               words[key] = word;
               return {};
             })
        .in("Parameters of representations");
  }
  return settings;
}

Settings representation_settings(StreamRequest& o, const std::vector<std::string>& more) {
  std::vector<std::string> names = more;
  for (const RepresentationInfo& info : representations()) names.push_back(info.name);
  Settings settings("StreamRequest");
  settings
      .add_text(Kind::word, "representation", o.representation, "Which picture; representations() lists them")
      .one_of(std::move(names));

  const std::string grid = "Patch grid of scarf";
  settings
      .add_parsed("preset", o.preset, parse_preset,
                  "paper (default), light, event_driven, event_driven_flex or explicit")
      .in(grid);
  settings.add_text(Kind::word, "cell", o.cell, "Pixels of a cell, default 9; WxH with preset explicit")
      .in(grid);
  settings
      .add_parsed("ratio", o.ratio, parse_number,
                  "Receptive field ratio, default 1.2; paper and event_driven_flex only")
      .in(grid);
  settings.add_parsed("alpha", o.alpha, parse_number, "Scale of the capacity, default 2.0").in(grid);
  const std::string with_explicit = "Patch grid of scarf, preset explicit";
  settings.add_parsed("origin", o.origin, parse_comma, "X,Y: first pixel of the first cell")
      .in(with_explicit);
  settings.add_parsed("grid", o.grid, parse_by, "WxH: number of patches").in(with_explicit);
  settings.add_parsed("margin-lo", o.margin_lo, parse_comma, "X,Y: field before the cell").in(with_explicit);
  settings.add_parsed("margin-hi", o.margin_hi, parse_comma, "X,Y: field behind the cell").in(with_explicit);
  settings.add_parsed("capacity", o.capacity, parse_whole<int32_t>, "Events that a patch holds")
      .in(with_explicit);

  settings.add(Kind::word, "accumulation",
               "Brightness of one event, default 0.3 (scarf; time_window with counts)",
               [&o](const std::string& word) -> Result<void> {
                 const auto value = parse_number(word);
                 if (!value) return value.error();
                 o.accumulation = *value;
                 o.parameters["accumulation"] = word;
                 return {};
               });
  settings.join(
      parameter_settings(o.parameters, representations().subspan(1), "accumulation"));  // SCARF's serves
  settings
      .add(
          Kind::word, "filter",
          "A noise filter in front, support:range=1,period=100ms or refractory:period=1ms; may be repeated",
          [&o](const std::string& word) -> Result<void> {
            const auto filter = parse_filter(word);
            if (!filter) return filter.error();
            o.filters.push_back(*filter);
            return {};
          },
          "filters")
      .in("Noise filters")
      .repeated = true;
  return settings;
}

Settings work_settings(StreamRequest& o) {
  const std::string work = "Work";
  Settings settings("StreamRequest");
  settings
      .add_parsed("batch", o.batches, parse_batch_sizes,
                  "Events per batch: N, random or random:SEED; never changes a result", "batches")
      .in(work);
  settings
      .add_text(Kind::word, "device", o.device.device, "Index, part of the name, UUID or type of the device")
      .in(work);
  settings.add_flag("require-gpu", o.device.require_gpu, "Refuse Vulkan devices that are CPUs").in(work);
  settings.add_flag("cpu", o.cpu, "The CPU reference, no Vulkan").in(work);
  settings.exclude("cpu", "device");
  settings.exclude("cpu", "require-gpu");
  return settings;
}

Settings stream_settings(StreamRequest& o, const std::vector<std::string>& more) {
  Settings settings("StreamRequest");
  settings.add_text(Kind::input, "file", o.file, "Recording; - is standard input").positional = true;
  settings.join(read_settings(o.read));
  settings.join(empty_settings(o.allow_empty));
  settings.join(representation_settings(o, more));
  settings.join(work_settings(o));
  return settings;
}

}  // namespace scarf
