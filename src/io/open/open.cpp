// Recognition of a recording's format by its content.
#include "io/open/open.h"

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "core/text.h"
#include "io/base/format.h"
#include "io/base/look_ahead.h"
#include "io/base/memory_guard.h"
#include "io/base/prophesee_header.h"
#include "io/base/watched_source.h"
#include "io/open/foreign_format.h"

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
      {!options.stream.empty(), kTakesStream, "ReadOptions::stream"},
      {!options.columns.empty(), kTakesColumns, "ReadOptions::columns"},
      {!options.time_unit.empty(), kTakesTimeUnit, "ReadOptions::time_unit"},
      {options.time_shift == TimeShift::first_high, kTakesFirstHigh, "ReadOptions::time_shift first-high"},
      {!options.yarp_time.empty(), kTakesYarpTime, "ReadOptions::yarp_time"},
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
  const ForeignFile foreign = foreign_file(bytes, input.name);
  if (!foreign.what.empty()) {
    return {foreign.recording ? ErrorCode::bad_input : ErrorCode::unrecognised, std::string(foreign.what)};
  }
  std::string_view what;
  if (input.folder) what = "this folder is no recording that scarf knows";
  if (input.header) what = "the header names no format, and the words do not tell";
  const bool empty = bytes.empty() && what.empty();
  if (empty && is_lost_if_empty(input.name)) {
    return {ErrorCode::bad_input, "the file is empty, as a broken download leaves it; fetch it again"};
  }
  if (what.empty()) what = empty ? "the file is empty" : "not recognised as events";
  const bool by_name = is_recording_by_name(input.name);
  if (by_name) what = "the file does not begin as its name says, so it is cut or damaged, or no recording";
  const bool recording = input.header.has_value() || by_name;
  return {recording ? ErrorCode::bad_input : ErrorCode::unrecognised,
          text(what, "; name the format with ReadOptions::format, formats() lists them")};
}

Result<const Format*> recognise(Input& input) {
  if (input.header && !input.header->format.empty()) return find_format(input.header->format);
  for (const size_t size : kLookAhead) {
    if (const auto filled = input.bytes.fill(size); !filled) return filled.error();
    // No more than asked for, or what is recognised would depend on how the input comes.
    const auto bytes = input.bytes.available().first(std::min(size, input.bytes.available().size()));
    const bool ended = input.bytes.ended() && bytes.size() == input.bytes.available().size();
    const Beginning beginning{bytes, ended, size == kLookAhead.back() || ended, input.path, input.folder};
    const bool foreign = !input.header && !foreign_file(beginning.bytes, input.name).what.empty();
    for (const Format* format : all_formats()) {
      if ((input.header && !format->prophesee) || (foreign && !format->packed)) continue;
      if (format->recognise != nullptr && format->recognise(beginning)) return format;
    }
    if (beginning.last || foreign) break;
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

// The format that is named, unless the file is surely none.
Result<const Format*> named_format(Input& input, const std::string& name) {
  constexpr size_t kEnough = 64;
  if (!input.header && !input.folder) {
    if (const auto filled = input.bytes.fill(kEnough); !filled) return filled.error();
    const ForeignFile foreign = foreign_file(input.bytes.available(), input.name);
    if (foreign.stand_in) return Error{ErrorCode::bad_input, std::string(foreign.what)};
  }
  return find_format(name);
}

template <class Source>
Result<std::unique_ptr<Source>> open_any(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto header = read_prophesee_header(input.bytes);
  if (!header) return named(name, header.error());
  input.header = *std::move(header);
  const auto format = options.format.empty() ? recognise(input) : named_format(input, options.format);
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
Result<std::unique_ptr<Source>> open_path(const std::string& path, const ReadOptions& options,
                                          ByteReader::Seen seen = {}) {
  std::error_code ignored;
  const bool folder = path != "-" && std::filesystem::is_directory(path, ignored);
  const auto files = std::make_shared<InputFiles>();
  auto bytes = folder ? ByteReader::over({}) : files->open(path);
  if (!bytes) return named(display_name(path), bytes.error());
  if (seen) bytes->observe(std::move(seen));
  const bool seekable = folder || bytes->total() > 0;
  auto source = open_any<Source>(
      {*std::move(bytes), seekable ? path : "", display_name(path), folder, {}, files}, options);
  if (!source) return reason(*files, source.error());
  return guarded(watched(*std::move(source), files));
}

}  // namespace

Result<std::unique_ptr<EventSource>> open_input(ByteReader input, const std::string& name,
                                                const ReadOptions& options) {
  return as_result([&]() -> Result<std::unique_ptr<EventSource>> {
    auto source = open_any<EventSource>({std::move(input), "", name, false, {}}, options);
    if (!source) return source;
    return guarded(*std::move(source));
  });
}

Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options) {
  return as_result([&] { return open_path<EventSource>(path, options); });
}

Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options,
                                                 ByteReader::Seen seen) {
  return as_result([&] { return open_path<EventSource>(path, options, std::move(seen)); });
}

Result<std::unique_ptr<FrameSource>> open_frames(const std::string& path, const ReadOptions& options) {
  return as_result([&] { return open_path<FrameSource>(path, options); });
}

Result<std::unique_ptr<TriggerSource>> open_triggers(const std::string& path, const ReadOptions& options) {
  return as_result([&] { return open_path<TriggerSource>(path, options); });
}

Result<SensorSize> require_sensor(const EventSource& source, const std::string& path) {
  if (const auto sensor = source.sensor()) return *sensor;
  return as_result([&]() -> Result<SensorSize> {
    return Error{ErrorCode::bad_input,
                 text(display_name(path),
                      ": the file does not say its sensor size; give it with ReadOptions::sensor WxH")};
  });
}

}  // namespace scarf
