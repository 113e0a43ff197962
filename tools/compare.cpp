// scarf compare: the first difference of two state dumps.
#include <iostream>

#include "compare/compare_states.h"
#include "compare/state_dump.h"
#include "core/text.h"
#include "tools/commands.h"
#include "tools/file_options.h"

namespace scarf::tools {
namespace {

struct CompareOptions {
  std::string a;
  std::string b;
};

int different(const std::string& difference) {
  std::cout << "different: " << difference << "\n";
  return 1;
}

Result<int> compare(const CompareOptions& options) {
  auto a = StateDump::open(options.a);
  if (!a) return a.error();
  auto b = StateDump::open(options.b);
  if (!b) return b.error();
  const SideNames names{options.a, options.b};
  if (const auto d = geometry_difference(a->geometry(), b->geometry(), names)) return different(*d);

  const auto patches = static_cast<size_t>(a->geometry().patches());
  uint64_t events = 0;
  for (size_t patch = 0; patch < patches; ++patch) {
    const auto patch_a = a->next();
    if (!patch_a) return patch_a.error();
    const auto patch_b = b->next();
    if (!patch_b) return patch_b.error();
    if (const auto d = patch_difference(patch, {patch_a->total, patch_a->slots},
                                        {patch_b->total, patch_b->slots}, names)) {
      return different(*d);
    }
    events += patch_a->slots.size();
  }
  for (StateDump* dump : {&*a, &*b}) {
    if (auto r = dump->finish(); !r) return r.error();
  }
  std::cout << text("identical: ", patches, " patches, ", events, " events\n");
  return 0;
}

}  // namespace

void add_compare(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("compare", "Compare two state dumps of scarf digest --dump");
  auto options = std::make_shared<CompareOptions>();
  add_input_option(*app, "a", options->a, "State dump")->required();
  add_input_option(*app, "b", options->b, "State dump")->required();
  app->callback([&command, options] { command.run = [options] { return compare(*options); }; });
}

}  // namespace scarf::tools
