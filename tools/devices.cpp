// scarf devices: the Vulkan devices, best first.
#include <iostream>

#include "core/text.h"
#include "scarf/device/stream.h"
#include "tools/commands.h"

namespace scarf::tools {
namespace {

Result<int> devices() {
  const auto list = list_devices();
  if (!list) return list.error();
  // Asking for a device is the one sure way to know which one would be chosen.
  const auto chosen = GpuContext::create();
  for (const DeviceInfo& d : *list) {
    const bool is_chosen =
        chosen && (*chosen)->device().uuid == d.uuid && (*chosen)->device().index == d.index;
    std::cout << text(is_chosen ? "* " : "  ", d.index, "  ", d.name, "\n",  //
                      "     type    ", d.type, "\n",                         //
                      "     uuid    ", d.uuid, "\n",                         //
                      "     driver  ", d.driver, "\n",                       //
                      "     api     ", d.api_version, "\n",                  //
                      "     memory  ", d.memory / (1024 * 1024), " MiB\n");
    if (!d.rejected.empty()) std::cout << "     rejected: " << d.rejected << "\n";
  }
  std::cout << (chosen ? "* would be chosen\n" : "none would be chosen: " + chosen.error().message + "\n");
  return 0;
}

}  // namespace

void add_devices(CLI::App& program, Command& command) {
  CLI::App* app =
      program.add_subcommand("devices", "Vulkan devices, best first, and which one would be chosen");
  app->callback([&command] { command.run = devices; });
}

}  // namespace scarf::tools
