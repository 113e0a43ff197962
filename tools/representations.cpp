// scarf representations: every representation with its parameters.
#include <iostream>

#include "core/text.h"
#include "scarf/core/parameters.h"
#include "tools/commands.h"

namespace scarf::tools {
namespace {

Result<int> print_representations() {
  for (const RepresentationInfo& info : representations()) {
    std::cout << text(info.name, "  ", info.description, "\n");
    for (const ParameterInfo& p : info.parameters) {
      std::cout << text("    --", p.name, " ", p.value, "  ", p.description, " (", p.range, ")\n");
    }
  }
  return 0;
}

}  // namespace

void add_representations(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("representations", "The representations and their parameters");
  app->callback([&command] { command.run = print_representations; });
}

}  // namespace scarf::tools
