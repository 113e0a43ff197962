// The format of a recording that is written.
#pragma once

#include <string>
#include <string_view>

#include "scarf/core/result.h"

namespace scarf::tools {

/// `given`, or without it the format that the name's extension stands for. `.raw` stands for the format of
/// the original where that is one of Prophesee RAW, and for EVT3 otherwise. Errors: illegal_parameter, naming
/// the extensions.
Result<std::string> output_format(const std::string& path, const std::string& given,
                                  std::string_view original = {});

/// ".raw evt3, .txt text, ...", for messages.
std::string output_extensions();

}  // namespace scarf::tools
