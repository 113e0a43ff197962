// What is asked of a recording, as words.
#pragma once

#include <string>
#include <vector>

#include "output/frame_request.h"
#include "output/product_request.h"
#include "session/request.h"
#include "session/settings.h"

namespace scarf::reprocess {

/// Replaces what `more` names. An instant (rate, every, at, at-times) also replaces the other instants.
void lay_over(SettingWords& settings, const SettingWords& more);

/// Settings as the parts of the program take them.
struct Options {
  StreamRequest stream;
  FrameRequest frames;
  ProductRequest products;           ///< `sparse` is added to the name of the recording, too
  std::vector<std::string> outputs;  ///< what is added to the name of the recording: ".png", ".frames/"
  bool skip = false;                 ///< the recording is left out
};

/// What is added to the name of the recording by all that is written but the record.
std::vector<std::string> suffixes_of(const SettingWords& settings);
/// The same, with the files that come beside some of them.
std::vector<std::string> result_suffixes(const SettingWords& settings);

/// The settings by which words fill in the options, which outlive them.
Settings settings_of(Options& options);
/// Errors: illegal_parameter, naming the setting.
Result<Options> parse_settings(const SettingWords& settings);

/// A message of the library in the words of a recipe: "time-policy" for "ReadOptions::time_policy".
std::string in_settings(const std::string& message);

/// The side file with the times of a recording: `name` with {path}, {folder}, {name} (without the folder) and
/// {stem} (without folder and extension) of the recording filled in; relative to the recording's folder, or
/// to the recording where that is a folder.
std::string side_file(const std::string& name, const std::string& recording);

}  // namespace scarf::reprocess
