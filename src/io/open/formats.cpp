// The list of all formats, and what can be asked of it.
#include <utility>

#include "core/text.h"
#include "io/base/format.h"
#include "io/base/known_formats.h"
#include "io/base/memory_guard.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

// Recognised in this order: signatures first, then what is guessed from many bytes.
constexpr const Format* kFormats[] = {
    &kMetavisionHdf5Format,
    &kMvsecFormat,
    &kM3edFormat,
    &kDsecFormat,
    &kRvtFormat,
    &kEventUtilsFormat,
    &kHdf5Format,
    &kAedat4Format,
    &kAedat3Format,
    &kAedat2Format,
    &kAedat1Format,
    &kRosbagFormat,
    &kRosbag2Format,
    &kMcapFormat,
    &kEventStreamFormat,
    &kNpyFormat,
    &kNpzFormat,
    &kEvimo2Format,
    &kEcdFormat,
    &kYarpFormat,
    &kCsvFormat,
    &kTextFormat,
    &kDatFormat,
    &kEvt2Format,
    &kEvt21Format,
    &kEvt3Format,
    &kEvt4Format,
    &kNmnistFormat,
};

std::string names(bool (*wanted)(const Format&)) {
  std::string list;
  for (const Format* format : kFormats) {
    if (wanted(*format)) list += text(list.empty() ? "" : ", ", format->name);
  }
  return list;
}

}  // namespace

std::span<const Format* const> all_formats() {
  return kFormats;
}

Result<const Format*> find_format(std::string_view name) {
  for (const Format* format : kFormats) {
    if (format->name == name) return format;
  }
  return Error{ErrorCode::illegal_parameter, text("the format '", name, "' is unknown; there are ",
                                                  names([](const Format&) { return true; }))};
}

Result<void> require_path(const Input& input, std::string_view title) {
  if (!input.path.empty()) return {};
  return Error{ErrorCode::bad_input,
               text(title, " cannot be read from a pipe; write it to a file first, and name that")};
}

std::vector<FormatInfo> formats() {
  std::vector<FormatInfo> list;
  for (const Format* format : kFormats) {
    list.push_back({std::string(format->name), std::string(format->title), std::string(format->missing),
                    format->recognise != nullptr || format->prophesee, format->create != nullptr,
                    format->open_frames != nullptr, format->open_triggers != nullptr, format->writes_header,
                    format->writes_triggers});
  }
  return list;
}

Result<void> EventSink::write_header(std::span<const HeaderLine>) {
  return Error{ErrorCode::bad_input, "the format has no room for the header of a camera"};
}

Result<void> EventSink::write_triggers(std::span<const Trigger>) {
  return Error{ErrorCode::bad_input, "the format has no room for triggers"};
}

namespace {

Result<std::unique_ptr<EventSink>> create_unguarded(const std::string& path, std::string_view name,
                                                    SensorSize sensor, const OutputRule& rule) {
  const auto format = find_format(name);
  if (!format) return format.error();
  if ((*format)->create == nullptr) {
    return Error{ErrorCode::illegal_parameter,
                 text("scarf does not write ", name, "; it writes ",
                      names([](const Format& f) { return f.create != nullptr; }))};
  }
  const auto legal = checked_sensor(sensor.width, sensor.height, text(path, ": the sensor size given"));
  if (!legal) return Error{ErrorCode::illegal_parameter, legal.error().message};
  return (*format)->create(path, sensor, rule);
}

}  // namespace

Result<std::unique_ptr<EventSink>> create_recording(const std::string& path, std::string_view name,
                                                    SensorSize sensor, const OutputRule& rule) {
  return as_result([&]() -> Result<std::unique_ptr<EventSink>> {
    auto sink = create_unguarded(path, name, sensor, rule);
    if (!sink) return sink.error();
    return guarded(*std::move(sink));
  });
}

Result<std::unique_ptr<EventSink>> create_events(const std::string& path, std::string_view name,
                                                 SensorSize sensor, const WriteOptions& options) {
  return as_result([&]() -> Result<std::unique_ptr<EventSink>> {
    return create_recording(path, name, sensor, OutputRule(options.overwrite, options.inputs));
  });
}

}  // namespace scarf
