// Options that name files. Every option says by its type name whether its file is read or written, and the
// rule of what may be written follows from that: a new option cannot be left out of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/files/output_files.h"

namespace scarf::tools {

/// Type names, as `--help` shows them. No option has CLI11's own name for text (see outputs_test.cpp).
inline constexpr const char* kInputType = "INPUT";
inline constexpr const char* kOutputType = "OUTPUT";
inline constexpr const char* kWordType = "WORD";  ///< text that names no file

/// A file or folder that is read; "-" is standard input where the sub-command takes it. Empty names are
/// errors.
CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::string& target,
                              const std::string& help);
CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                              const std::string& help);
/// A file or folder that is written. The sub-command gets --overwrite as well. Empty names are errors.
CLI::Option* add_output_option(CLI::App& app, const std::string& name, std::string& target,
                               const std::string& help);
/// Makes an option that exists one of these.
CLI::Option* as_input(CLI::Option* option);
CLI::Option* as_output(CLI::App& app, CLI::Option* option);
/// Text that is neither.
CLI::Option* add_word_option(CLI::App& app, const std::string& name, std::string& target,
                             const std::string& help);

/// The rule for what a sub-command writes, by its parsed options.
OutputRule output_rule(const CLI::App& app);
/// Whether standard output and standard error may be written to: neither is a file that the sub-command
/// reads. Errors: illegal_parameter.
Result<void> check_standard_streams(const CLI::App& app);

}  // namespace scarf::tools
