#include "tools/recording_copy.h"

#include <algorithm>
#include <iostream>
#include <vector>

#include "core/text.h"
#include "io/format.h"
#include "scarf/digest.h"
#include "tools/file_options.h"
#include "tools/output_format.h"
#include "tools/play.h"
#include "tools/progress.h"

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

}  // namespace

Result<Copied> copy_recording(EventSource& source, const Choose& choose, SensorSize sensor,
                              const CopyTarget& target, const OutputRule& rule) {
  const auto format = output_format(target.path, target.format);
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
  EventDigest digest;
  std::vector<Event> wanted;
  const auto take = [&](std::span<const Event> events) -> Result<void> {
    wanted.clear();
    for (Event e : events) {
      if (!choose(e)) continue;
      wanted.push_back(e);
      digest.add(e);
    }
    copied.events += wanted.size();
    copied.left += events.size() - wanted.size();
    return (*sink)->write(wanted);
  };
  {
    Progress progress(source);
    const auto counted = [&](std::span<const Event> events) {
      progress.add(events.size());
      return take(events);
    };
    if (const auto played = play(source, {}, {.events = counted}); !played) return played.error();
  }
  if (auto r = (*sink)->finish(); !r) return r.error();
  copied.digest = digest.hex();
  if (target.check) {
    const auto again = digest_of(target.path, *format, sensor);
    if (!again) return again.error();
    if (*again != copied.digest) {
      return Error{ErrorCode::bad_input, text(target.path, ": read again, the copy has the event digest ",
                                              *again, " instead of ", copied.digest, "; do not use it")};
    }
  }
  return copied;
}

void add_copy_target(CLI::App& app, CopyTarget& target) {
  add_output_option(
      app, "output", target.path,
      "Recording to write, in the format of its name (" + output_extensions() + "); - is standard output")
      ->required();
  add_word_option(app, "--output-format", target.format,
                  "Format of the output, where its name does not tell; see scarf formats");
  app.add_flag("--check", target.check, "Read the output again and compare it with what was written");
}

std::ostream& remarks(const CopyTarget& target) {
  return target.path == "-" || target.path == "/dev/stdout" ? std::cerr : std::cout;
}

std::string losses(const EventSource& source) {
  const ReadReport& report = source.report();
  std::string lines;
  const auto line = [&](uint64_t count, std::string_view what) {
    if (count > 0) lines += text("lost: ", count, " ", what, "\n");
  };
  line(report.outside, "events outside the sensor");
  line(report.dropped, "events older than one before them");
  line(report.unknown_words, "words or lines that the format does not define");
  line(report.truncated_bytes, "bytes at the end that make no whole word, line or packet");
  line(report.damages, "damaged places");
  const auto all = formats();
  const auto info =
      std::find_if(all.begin(), all.end(), [&](const FormatInfo& f) { return f.name == source.format(); });
  if (info != all.end() && (info->frames || info->triggers)) {
    lines += text("not copied: ", info->frames ? "frames" : "", info->frames && info->triggers ? " and " : "",
                  info->triggers ? "triggers" : "", ", if the recording has any\n");
  }
  return lines;
}

}  // namespace scarf::tools
