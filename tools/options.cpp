#include "tools/options.h"

#include <string_view>
#include <utility>
#include <vector>

#include "core/text.h"
#include "output/frame_request.h"
#include "output/product_request.h"
#include "session/request.h"

namespace scarf::tools {
namespace {

std::string option_name(const Setting& setting) {
  return setting.positional ? setting.name : "--" + setting.name;
}

void set_or_throw(const Setting& setting, const std::string& word) {
  const auto r = set(setting, word);
  if (!r) throw CLI::ValidationError(option_name(setting), in_options(r.error().message));
}

CLI::Option* add_setting(CLI::App& app, const Setting& setting) {
  const std::string name = option_name(setting);
  const auto set_word = [setting](const std::string& word) { set_or_throw(setting, word); };
  switch (setting.kind) {
    case Setting::Kind::flag:
      return app.add_flag_callback(
          name, [set_word] { set_word("true"); }, setting.help);
    case Setting::Kind::input:
      return as_input(app.add_option_function<std::string>(name, set_word, setting.help));
    case Setting::Kind::output:
      return as_output(app, app.add_option_function<std::string>(name, set_word, setting.help));
    case Setting::Kind::word:
      break;
  }
  if (!setting.repeated)
    return app.add_option_function<std::string>(name, set_word, setting.help)->type_name(kWordType);
  return app
      .add_option_function<std::vector<std::string>>(
          name,
          [set_word](const std::vector<std::string>& words) {
            for (const std::string& word : words) set_word(word);
          },
          setting.help)
      ->type_name(kWordType);
}

// What the library says of things that are no settings of a request, in words of the program.
std::string in_commands(std::string said) {
  for (const auto& [library, program] :
       {std::pair{"WriteOptions::overwrite", "--overwrite"}, std::pair{"formats()", "`scarf formats`"},
        std::pair{"representations()", "`scarf representations`"}, std::pair{"name a Shard", "give --shard"},
        std::pair{"open_triggers() reads them", "`scarf triggers` reads them"},
        std::pair{"write_state_dump() writes one", "write one with scarf digest --dump"},
        std::pair{"use fewer workers", "use fewer --jobs"}}) {
    for (size_t at = 0; (at = said.find(library, at)) != std::string::npos;) {
      said.replace(at, std::string_view(library).size(), program);
      at += std::string_view(program).size();
    }
  }
  return said;
}

}  // namespace

void add_settings(CLI::App& app, const Settings& settings) {
  for (const Setting& setting : settings.all()) {
    CLI::Option* const option = add_setting(app, setting);
    if (!setting.group.empty()) option->group(setting.group);
    const bool chosen = !setting.choices.empty() && setting.kind == Setting::Kind::word;
    option->description(
        in_commands(setting.help + (chosen ? text(" (", listed(setting.choices), ")") : std::string())));
    if (setting.positional) option->required();
  }
  for (const auto& [one, other] : settings.exclusions()) {
    app.get_option("--" + one)->excludes(app.get_option("--" + other));
  }
  for (const auto& [name, needed] : settings.needs()) {
    app.get_option("--" + name)->needs(app.get_option("--" + needed));
  }
}

void add_decode_option(CLI::App& app, bool& on_device) {
  app.add_option_function<std::string>(
         "--decode", [&on_device](const std::string& word) { on_device = word == "device"; },
         "Where EVT2 and EVT3 words become events: cpu (default) or device; never changes a result")
      ->check(CLI::IsMember({"cpu", "device"}))
      ->group("Work");
}

std::string in_options(const std::string& message) {
  StreamRequest stream;
  FrameRequest frames;
  ProductRequest products;
  Settings all = stream_settings(stream);
  all.join(frame_settings(frames));
  all.join(product_settings(products, ""));
  return in_commands(with_names(message, all, option_name));
}

}  // namespace scarf::tools
