#include "tools/commands.h"

namespace scarf::tools {

void add_commands(CLI::App& program, Command& command) {
  add_formats(program, command);
  add_info(program, command);
  add_convert(program, command);
  add_cut(program, command);
  add_representations(program, command);
  add_digest(program, command);
  add_compare(program, command);
  add_triggers(program, command);
  add_verify(program, command);
  add_devices(program, command);
  add_bench(program, command);
#ifdef SCARF_PICTURES
  add_frames(program, command);
  add_render(program, command);
  add_reprocess(program, command);
  add_simulate(program, command);
#endif
}

}  // namespace scarf::tools
