// scarf triggers: the edges at the camera's trigger inputs.
#include <array>
#include <iostream>

#include "core/text.h"
#include "io/files/write_file.h"
#include "scarf/io/frames.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

struct TriggersOptions {
  std::string file;
  std::string output;  // empty: standard output
  ReadOptions read;
  bool allow_empty = false;
};

Result<int> triggers(const TriggersOptions& options, const OutputRule& rule) {
  if (!options.output.empty()) {
    if (auto r = rule.check(options.output); !r) return r.error();
  }
  const auto source = open_triggers(options.file, options.read);
  if (!source) return source.error();
  std::string lines = "t_us,id,value\n";
  bool any = options.allow_empty;
  std::array<Trigger, 1024> some;
  for (;;) {
    const auto count = (*source)->read(some);
    if (!count) return count.error();
    any |= *count > 0;
    if (!any) {
      return Error{ErrorCode::bad_input,
                   text(options.file, ": it holds no trigger; if that is right, give --allow-empty")};
    }
    for (size_t i = 0; i < *count; ++i) {
      lines += text(some[i].t, ",", some[i].id, ",", int{some[i].value}, "\n");
    }
    if (options.output.empty()) {
      std::cout << lines;
      lines.clear();
    }
    if (*count == 0) break;
  }
  if (options.output.empty()) return 0;
  if (auto r = write_file(options.output, lines, rule); !r) return r.error();
  return 0;
}

}  // namespace

void add_triggers(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand(
      "triggers", "The external triggers of a recording as lines `t_us,id,value`; value 1 is a rising edge");
  auto options = std::make_shared<TriggersOptions>();
  add_input_option(*app, "file", options->file, "Recording; - is standard input")->required();
  add_output_option(*app, "-o,--output", options->output, "CSV file to write instead of standard output");
  add_settings(*app, read_settings(options->read));
  add_settings(*app, empty_settings(options->allow_empty));
  app->callback([&command, app, options] {
    command.run = [app, options] { return triggers(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
