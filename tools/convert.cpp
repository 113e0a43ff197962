// scarf convert: a recording in another format.
#include <iostream>

#include "core/text.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/output_format.h"
#include "tools/recording_copy.h"

namespace scarf::tools {
namespace {

struct ConvertOptions {
  std::string file;
  ReadOptions read;
  CopyTarget target;
};

Result<int> convert(const ConvertOptions& options, const OutputRule& rule) {
  if (auto r = rule.check(options.target.path); !r) return r.error();
  const auto source = open_events(options.file, options.read);
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  const Choose everything = {.event = [](Event&) { return true; },
                             .trigger = [](const Trigger&) { return true; }};
  const auto copied =
      copy_recording({**source, options.file, options.read}, everything, *sensor, options.target, rule);
  if (!copied) return copied.error();
  const ReadReport& report = (*source)->report();
  std::string changed;
  if (options.read.time_policy == TimePolicy::clamp && report.back_steps > 0) {
    changed += text("changed: ", report.back_steps, " times of back-steps\n");
  }
  if (options.read.time_shift != TimeShift::none) changed += "changed: all times, by --time-shift\n";
  remarks(options.target) << text(
      "converted ", copied->events, " events from ", (*source)->format(), " to ", copied->format,
      options.target.check ? ", checked" : "", "\n", beside_events(*copied), changed, copied->losses,
      changed.empty() && copied->losses.empty() ? "lossless\n" : "", "events ", copied->digest, "\n");
  return 0;
}

}  // namespace

void add_convert(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("convert", "A recording in another format");
  auto options = std::make_shared<ConvertOptions>();
  add_input_option(*app, "file", options->file, "Recording; - is standard input")->required();
  add_copy_target(*app, options->target);
  add_settings(*app, read_settings(options->read));
  app->callback([&command, app, options] {
    command.run = [app, options] { return convert(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
