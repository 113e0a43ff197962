// How the settings of the library's requests become options, and how its messages come to speak of them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scarf/core/result.h"
#include "session/settings.h"
#include "tools/file_options.h"

namespace scarf::tools {

/// Adds an option whose word is read by `parse`; its error becomes the parser's.
template <class T, class Target>
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, Target& target,
                               Result<T> (*parse)(const std::string&), const std::string& help) {
  // CLI11 runs the check before the callback, so the word is known to be good there.
  return app
      .add_option_function<std::string>(
          name, [&target, parse](const std::string& word) { target = *parse(word); }, help)
      ->type_name(kWordType)
      ->check([parse](const std::string& word) {
        const auto value = parse(word);
        return value ? std::string() : value.error().message;
      });
}

/// Every setting becomes an option of its name.
void add_settings(CLI::App& app, const Settings& settings);

/// --decode cpu|device.
void add_decode_option(CLI::App& app, bool& on_device);

/// A message of the library, in which "ReadOptions::time_policy" has become "--time-policy", and so on.
std::string in_options(const std::string& message);

}  // namespace scarf::tools
