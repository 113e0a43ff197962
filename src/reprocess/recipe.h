// A recipe: what is asked of every recording, and what else of those whose path matches a pattern.
#pragma once

#include <string>
#include <vector>

#include "reprocess/settings.h"

namespace scarf::reprocess {

struct Recipe {
  struct Rule {
    std::string
        match;  ///< as in a shell, * also for /; without / it is compared with the last part of a path
    SettingWords settings;
  };

  SettingWords settings;
  std::vector<Rule> rules;  ///< later ones come on top

  /// What is asked of the recording at a relative path.
  SettingWords for_recording(const std::string& relative) const;
};

/// SCARF, preset paper, one picture at the end.
Recipe default_recipe();

/// A TOML file on top of the default: settings, and tables [[input]] with `match` and settings.
/// Errors: io; illegal_parameter, naming the line, also for settings that are none.
Result<Recipe> read_recipe(const std::string& path);
/// The content of such a file, which messages call `path`. Errors: as read_recipe.
Result<Recipe> parse_recipe(const std::string& content, const std::string& path);

}  // namespace scarf::reprocess
