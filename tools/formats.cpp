// scarf formats: what scarf reads and writes.
#include <iomanip>
#include <iostream>

#include "scarf/io/recordings.h"
#include "tools/commands.h"

namespace scarf::tools {
namespace {

Result<int> print_formats() {
  for (const FormatInfo& info : formats()) {
    std::cout << std::left << std::setw(15) << info.name << std::setw(12)
              << (!info.missing.empty() ? "not built"
                  : info.written        ? "read, write"
                                        : "read")
              << " " << info.title;
    if (!info.missing.empty()) std::cout << " (needs " << info.missing << ")";
    if (!info.recognised && info.missing.empty()) std::cout << " (only with --format " << info.name << ")";
    std::cout << "\n";
  }
  return 0;
}

}  // namespace

void add_formats(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("formats", "The formats that are read and written");
  app->callback([&command] { command.run = print_formats; });
}

}  // namespace scarf::tools
