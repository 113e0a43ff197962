// The sub-commands of the program: one file each, which adds its options to the parser and sets what to run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "scarf/core/result.h"

namespace scarf::tools {

/// What the command line asked for.
struct Command {
  /// Set when a sub-command was parsed. Returns the exit code: 0 fine, 1 where the job's answer is "no" and
  /// has been printed. An Error is printed by main in one line; illegal_parameter exits with 2, every other
  /// with 1.
  std::function<Result<int>()> run;
};

/// All that this build has.
void add_commands(CLI::App& program, Command& command);

// Each adds its sub-command to `program`, in this manner:
//   CLI::App* app = program.add_subcommand("digest", "...");
//   auto options = std::make_shared<DigestOptions>();
//   add_input_option(*app, "file", options->file, "...")->required();
//   app->callback([&command, app, options] {
//     command.run = [app, options] { return digest(*options, output_rule(*app)); };
//   });
void add_bench(CLI::App& program, Command& command);
void add_compare(CLI::App& program, Command& command);
void add_convert(CLI::App& program, Command& command);
void add_cut(CLI::App& program, Command& command);
void add_devices(CLI::App& program, Command& command);
void add_digest(CLI::App& program, Command& command);
void add_formats(CLI::App& program, Command& command);
void add_frames(CLI::App& program, Command& command);
void add_info(CLI::App& program, Command& command);
void add_representations(CLI::App& program, Command& command);
void add_render(CLI::App& program, Command& command);
void add_reprocess(CLI::App& program, Command& command);
void add_simulate(CLI::App& program, Command& command);
void add_triggers(CLI::App& program, Command& command);
void add_verify(CLI::App& program, Command& command);

}  // namespace scarf::tools
