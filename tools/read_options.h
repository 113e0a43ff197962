// Options of every sub-command that reads a recording: how it is read.
#pragma once

#include <CLI/CLI.hpp>

#include "scarf/io.h"

namespace scarf::tools {

void add_read_options(CLI::App& app, ReadOptions& options);

/// --allow-empty, of what makes something of a recording.
void add_allow_empty(CLI::App& app, bool& allow_empty);

/// A job whose recording gave not one event has failed, unless that is allowed. Errors: bad_input, saying
/// what the reader met instead.
Result<void> require_events(const std::string& path, const ReadReport& report, bool allow_empty);

}  // namespace scarf::tools
