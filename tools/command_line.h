// What is checked of a command line before it is parsed.
#pragma once

#include <span>
#include <string_view>

#include "scarf/core/result.h"

namespace scarf::tools {

/// The arguments behind the program's name. An empty one is what an unset variable of a shell leaves, and no
/// option and no name of a file takes it. Errors: illegal_parameter, naming the option.
Result<void> check_arguments(std::span<const char* const> arguments);

}  // namespace scarf::tools
