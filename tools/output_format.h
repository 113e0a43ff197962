// The format of a recording that is written.
#pragma once

#include <string>

#include "scarf/result.h"

namespace scarf::tools {

/// `given`, or without it the format that the name's extension stands for. Errors: illegal_parameter, naming
/// the extensions.
Result<std::string> output_format(const std::string& path, const std::string& given);

/// ".raw evt3, .txt text, ...", for messages.
std::string output_extensions();

}  // namespace scarf::tools
