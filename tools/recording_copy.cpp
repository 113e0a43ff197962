#include "tools/recording_copy.h"

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/base/format.h"
#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"
#include "session/play.h"
#include "session/progress.h"
#include "session/request.h"
#include "tools/file_options.h"
#include "tools/options.h"
#include "tools/output_format.h"

namespace scarf::tools {
namespace {

Result<std::string> digest_of(const std::string& path, const std::string& format, SensorSize sensor) {
  const auto source = open_events(path, {.sensor = sensor, .format = format});
  if (!source) return source.error();
  EventDigest digest;
  const auto take = [&](std::span<const Event> events) -> Result<void> {
    for (const Event& e : events) digest.add(e);
    return {};
  };
  if (const auto played = play(**source, {}, {.events = take}); !played) return played.error();
  return digest.hex();
}

std::string losses(const EventSource& source) {
  const ReadReport& report = source.report();
  std::string lines;
  const auto line = [&](uint64_t count, std::string_view what) {
    if (count > 0) lines += text("lost: ", count, " ", what, "\n");
  };
  line(report.outside, "events outside the sensor");
  line(report.dropped, "events older than one before them");
  line(report.undefined_polarities, "events whose polarity the format does not define");
  line(report.unknown_words, "words or lines that the format does not define");
  line(report.skipped, "records of other things than events, or marked as not valid");
  line(report.truncated_bytes, "bytes at the end that make no whole word, line or packet");
  line(report.damages, "damaged places");
  return lines;
}

// What the copy does not have because of `format`, as formats() tells it.
FormatInfo info_of(std::string_view format) {
  const auto all = formats();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const FormatInfo& f) { return f.name == format; });
  return found == all.end() ? FormatInfo{} : *found;
}

// No format that scarf writes has room for frames.
std::string frames_lost(const Original& original) {
  if (!info_of(original.source.format()).frames) return "";
  if (!can_be_read_twice(original.path)) return "not copied: frames, if there are any\n";
  ReadOptions read = original.read;
  read.time_shift = TimeShift::none;
  auto frames = open_frames(original.path, read);
  if (!frames && !read.stream.empty()) {  // it may name a stream of events
    read.stream.clear();
    frames = open_frames(original.path, read);
  }
  if (!frames) {
    return frames.error().code == ErrorCode::unrecognised
               ? ""
               : text("not copied: frames, if there are any: ", in_options(frames.error().message), "\n");
  }
  const auto first = (*frames)->read();
  return first && !*first ? "" : "not copied: frames; scarf frames writes them\n";
}

Result<std::string> copy_header(const EventSource& source, EventSink& sink, const std::string& format) {
  const auto lines = source.header();
  if (lines.empty()) return std::string();
  if (info_of(format).writes_header) {
    if (auto r = sink.write_header(lines); !r) return r.error();
    return std::string();
  }
  std::string keys;
  for (const HeaderLine& line : lines) keys += text(keys.empty() ? "" : ", ", line.key);
  return text("not copied: the camera's header (", keys, "); ", format, " has no room for it\n");
}

Result<void> check_copy(const CopyTarget& target, SensorSize sensor, const Copied& copied,
                        const std::string& triggers) {
  const auto events = digest_of(target.path, copied.format, sensor);
  if (!events) return events.error();
  if (*events != copied.digest) {
    return Error{ErrorCode::bad_input, text(target.path, ": read again, the copy has the event digest ",
                                            *events, " instead of ", copied.digest, "; do not use it")};
  }
  if (!info_of(copied.format).writes_triggers) return {};
  const auto again = triggers_digest(target.path, {.sensor = sensor, .format = copied.format});
  if (!again) return again.error();
  if (*again == triggers) return {};
  return Error{
      ErrorCode::bad_input,
      text(target.path, ": read again, the copy has other triggers than were written; do not use it")};
}

}  // namespace

Result<Copied> copy_recording(const Original& original, const Choose& choose, SensorSize sensor,
                              const CopyTarget& target, const OutputRule& rule) {
  EventSource& source = original.source;
  const auto format = output_format(target.path, target.format, source.format());
  if (!format) return format.error();
  if (target.check && target.path == "-") {
    return Error{
        ErrorCode::illegal_parameter,
        "--check reads the copy again, which standard output cannot do; name a file, or leave it out"};
  }
  const auto sink = create_recording(target.path, *format, sensor, rule);
  if (!sink) return sink.error();

  Copied copied;
  copied.format = *format;
  const auto header_lost = copy_header(source, **sink, *format);
  if (!header_lost) return header_lost.error();
  if (header_lost->empty()) copied.header_lines = source.header().size();
  EventSink* const trigger_sink = info_of(*format).writes_triggers ? sink->get() : nullptr;
  auto triggers = TriggerCopy::open(original, trigger_sink, *format, choose.trigger);
  if (!triggers) return triggers.error();

  EventDigest digest;
  std::vector<Event> wanted;
  bool begun = false;
  const auto write_wanted = [&]() -> Result<void> {
    copied.events += wanted.size();
    const auto written = (*sink)->write(wanted);
    wanted.clear();
    return written;
  };
  const auto take = [&](std::span<const Event> events) -> Result<void> {
    if (!std::exchange(begun, true)) {
      if (auto r = choose.begin(events.front()); !r) return r;
    }
    for (Event e : events) {
      if (triggers->due_before(e.t)) {
        if (auto r = write_wanted(); !r) return r;
        if (auto r = triggers->write_before(e); !r) return r;
      }
      if (!choose.event(e)) {
        ++copied.left;
        continue;
      }
      wanted.push_back(e);
      digest.add(e);
    }
    return write_wanted();
  };
  {
    Progress progress(source);
    const auto counted = [&](std::span<const Event> events) {
      progress.add(events.size());
      return take(events);
    };
    if (const auto played = play(source, {}, {.events = counted}); !played) return played.error();
  }
  if (auto r = require_events(original.path, source.report(), target.allow_empty); !r) return r.error();
  if (copied.events == 0 && !target.allow_empty) {
    return Error{ErrorCode::bad_input, text("none of the ", copied.left, " events of ", original.path,
                                            " was asked for; if that is right, give --allow-empty")};
  }
  if (auto r = triggers->finish(); !r) return r.error();
  if (auto r = (*sink)->finish(); !r) return r.error();
  copied.digest = digest.hex();
  copied.triggers = triggers->written();
  copied.losses = losses(source) + triggers->losses() + frames_lost(original) + *header_lost;
  if (target.check) {
    if (auto r = check_copy(target, sensor, copied, triggers->digest()); !r) return r.error();
  }
  return copied;
}

std::string beside_events(const Copied& copied) {
  std::string with;
  if (copied.triggers > 0) with += text(copied.triggers, " triggers");
  if (copied.header_lines > 0) {
    with += text(with.empty() ? "" : " and ", copied.header_lines, " lines of the camera's header");
  }
  return with.empty() ? "" : text("with ", with, "\n");
}

void add_copy_target(CLI::App& app, CopyTarget& target) {
  add_output_option(app, "output", target.path,
                    "Recording to write, in the format of its name (" + output_extensions() +
                        "; .raw keeps the EVT version of a RAW recording); - is standard output")
      ->required();
  add_word_option(app, "--output-format", target.format,
                  "Format of the output, where its name does not tell; see scarf formats");
  app.add_flag("--check", target.check, "Read the output again and compare it with what was written");
  add_settings(app, empty_settings(target.allow_empty));
}

std::ostream& remarks(const CopyTarget& target) {
  return target.path == "-" || target.path == "/dev/stdout" ? std::cerr : std::cout;
}

}  // namespace scarf::tools
