// A list of recordings.
//
// Text: a path per line, and behind it, separated by tabs, settings NAME=VALUE; empty lines and lines that
// begin with # are left out. Or JSON, an object per line: {"path": "a.raw", "geometry": "240x180"}. Paths
// are relative to the folder of the list. The setting `as` is the relative path of what is written.
#pragma once

#include <string>
#include <vector>

#include "reprocess/settings.h"

namespace scarf::reprocess {

struct Listed {
  size_t line = 0;
  std::string path;  ///< as it is written there
  std::string as;    ///< empty: as the path
  SettingWords settings;
};

/// Errors: io; illegal_parameter, naming the line.
Result<std::vector<Listed>> read_manifest(const std::string& path);

}  // namespace scarf::reprocess
