// What is asked of a recording, as words: the options of `scarf render` by name, without their dashes.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/frame_options.h"
#include "tools/options.h"
#include "tools/product_options.h"

namespace scarf::tools::reprocess {

/// "geometry" -> {"240x180"}; several values where an option may be repeated.
using Settings = std::map<std::string, std::vector<std::string>>;

/// Replaces what `more` names. An instant (rate, every, at, at-times) also replaces the other instants.
void lay_over(Settings& settings, const Settings& more);

/// Settings as the parts of the program take them.
struct Options {
  StreamOptions stream;
  FrameOptions frames;
  ProductOptions products;           ///< `sparse` is added to the name of the recording, too
  std::vector<std::string> outputs;  ///< what is added to the name of the recording: ".png", ".frames/"
  bool skip = false;                 ///< the recording is left out
  CLI::App app;                      ///< `stream` points into it
};

/// What is added to the name of the recording by all that is written but the record.
std::vector<std::string> suffixes_of(const Settings& settings);
/// The same, with the files that come beside some of them.
std::vector<std::string> result_suffixes(const Settings& settings);

/// Errors: illegal_parameter, naming the setting.
Result<std::unique_ptr<Options>> parse_settings(const Settings& settings);

/// The side file with the times of a recording: `name` with {path}, {folder}, {name} (without the folder) and
/// {stem} (without folder and extension) of the recording filled in; relative to the recording's folder, or
/// to the recording where that is a folder.
std::string side_file(const std::string& name, const std::string& recording);

}  // namespace scarf::tools::reprocess
