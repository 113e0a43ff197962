// Options of every sub-command that reads a recording: how it is read.
#pragma once

#include <CLI/CLI.hpp>

#include "scarf/io.h"

namespace scarf::tools {

void add_read_options(CLI::App& app, ReadOptions& options);

}  // namespace scarf::tools
