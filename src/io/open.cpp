// Recognition of a recording's format by its content.
#include "io/open.h"

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "core/text.h"
#include "io/foreign_format.h"
#include "io/format.h"
#include "io/look_ahead.h"
#include "io/prophesee_header.h"

namespace scarf {
namespace {

Error illegal(std::string message) {
  return {ErrorCode::illegal_parameter, std::move(message)};
}

// Which function of a format makes the source, and what to say of formats that have none.
template <class Source>
struct Kind;
template <>
struct Kind<EventSource> {
  static constexpr auto kOpen = &Format::open;
  static constexpr std::string_view kWhat = "events";
};
template <>
struct Kind<FrameSource> {
  static constexpr auto kOpen = &Format::open_frames;
  static constexpr std::string_view kWhat = "frames";
};
template <>
struct Kind<TriggerSource> {
  static constexpr auto kOpen = &Format::open_triggers;
  static constexpr std::string_view kWhat = "triggers";
};

// An option that the format has no use for is a mistake, and is not passed over.
Result<void> check_options(const Format& format, const ReadOptions& options) {
  const struct {
    bool given;
    uint32_t option;
    std::string_view name;
  } uses[] = {
      {!options.stream.empty(), kTakesStream, "--stream"},
      {!options.columns.empty(), kTakesColumns, "--columns"},
      {!options.time_unit.empty(), kTakesTimeUnit, "--time-unit"},
      {options.time_shift == TimeShift::first_high, kTakesFirstHigh, "--time-shift first-high"},
      {!options.yarp_time.empty(), kTakesYarpTime, "--yarp-time"},
  };
  for (const auto& use : uses) {
    if (use.given && (format.options & use.option) == 0) {
      return illegal(text(use.name, " is not used by ", format.name, "; leave it out"));
    }
  }
  return {};
}

template <class Source>
Result<std::unique_ptr<Source>> open_as(const Format& format, Input input, const ReadOptions& options) {
  if (!format.missing.empty()) {
    return Error{ErrorCode::bad_input, text("this is ", format.title, ", and this build of scarf has no ",
                                            format.missing, "; install it and build again")};
  }
  if (format.*Kind<Source>::kOpen == nullptr) {
    return Error{ErrorCode::unrecognised,
                 text(format.title, " has no ", Kind<Source>::kWhat, " that scarf reads")};
  }
  if (auto r = check_options(format, options); !r) return r.error();
  return (format.*Kind<Source>::kOpen)(std::move(input), options);
}

Error unrecognised(const Input& input) {
  const auto bytes = input.bytes.available();
  std::string_view what = foreign_format(bytes);
  if (!what.empty()) return {ErrorCode::bad_input, std::string(what)};
  if (input.folder) what = "this folder is no recording that scarf knows";
  if (input.header) what = "the header names no format, and the words do not tell";
  if (what.empty()) what = bytes.empty() ? "the file is empty" : "not recognised as events";
  const bool recording = input.header || foreign_recording(bytes);
  return {recording ? ErrorCode::bad_input : ErrorCode::unrecognised,
          text(what, "; name the format with --format, `scarf formats` lists them")};
}

Result<const Format*> recognise(Input& input) {
  if (input.header && !input.header->format.empty()) return find_format(input.header->format);
  for (const size_t size : kLookAhead) {
    if (const auto filled = input.bytes.fill(size); !filled) return filled.error();
    // No more than asked for, or what is recognised would depend on how the input comes.
    const auto bytes = input.bytes.available().first(std::min(size, input.bytes.available().size()));
    const bool ended = input.bytes.ended() && bytes.size() == input.bytes.available().size();
    const Beginning beginning{bytes, ended, size == kLookAhead.back() || ended, input.path, input.folder};
    if (!input.header && !foreign_format(beginning.bytes).empty()) break;
    for (const Format* format : all_formats()) {
      if (input.header && !format->prophesee) continue;
      if (format->recognise != nullptr && format->recognise(beginning)) return format;
    }
    if (beginning.last) break;
  }
  return unrecognised(input);
}

std::string display_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

// An error of opening names the file.
Error named(const std::string& name, const Error& error) {
  return {error.code, text(name, ": ", error.message)};
}

template <class Source>
Result<std::unique_ptr<Source>> open_any(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto header = read_prophesee_header(input.bytes);
  if (!header) return named(name, header.error());
  input.header = *std::move(header);
  const auto format = options.format.empty() ? recognise(input) : find_format(options.format);
  if (!format) return named(name, format.error());
  auto source = open_as<Source>(**format, std::move(input), options);
  if (source) return source;
  Error error = named(name, source.error());
  // Who names the format says that this is a recording, though not that it has frames or triggers.
  constexpr bool kEvents = std::is_same_v<Source, EventSource>;
  if (kEvents && !options.format.empty() && error.code == ErrorCode::unrecognised)
    error.code = ErrorCode::bad_input;
  return error;
}

template <class Source>
Result<std::unique_ptr<Source>> open_path(const std::string& path, const ReadOptions& options) {
  std::error_code ignored;
  const bool folder = path != "-" && std::filesystem::is_directory(path, ignored);
  auto bytes = folder ? ByteReader::over({}) : ByteReader::open(path);
  if (!bytes) return named(display_name(path), bytes.error());
  const bool seekable = folder || bytes->total() > 0;
  return open_any<Source>({*std::move(bytes), seekable ? path : "", display_name(path), folder, {}}, options);
}

}  // namespace

Result<std::unique_ptr<EventSource>> open_input(ByteReader input, const std::string& name,
                                                const ReadOptions& options) {
  return open_any<EventSource>({std::move(input), "", name, false, {}}, options);
}

Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options) {
  return open_path<EventSource>(path, options);
}

Result<std::unique_ptr<FrameSource>> open_frames(const std::string& path, const ReadOptions& options) {
  return open_path<FrameSource>(path, options);
}

Result<std::unique_ptr<TriggerSource>> open_triggers(const std::string& path, const ReadOptions& options) {
  return open_path<TriggerSource>(path, options);
}

Result<SensorSize> require_sensor(const EventSource& source, const std::string& path) {
  if (const auto sensor = source.sensor()) return *sensor;
  return Error{
      ErrorCode::bad_input,
      text(display_name(path), ": the file does not say its sensor size; give it with --geometry WxH")};
}

}  // namespace scarf
