#include "tools/command_line.h"

#include "core/parse.h"
#include "core/text.h"

namespace scarf::tools {
namespace {

Error empty(std::string_view option) {
  return {ErrorCode::illegal_parameter, text(option, " is empty; give it a value, or leave the option out")};
}

}  // namespace

Result<void> check_arguments(std::span<const char* const> arguments) {
  std::string_view before;
  for (const std::string_view argument : arguments) {
    if (is_blank(argument)) {
      if (before.starts_with('-') && before.size() > 1) return empty(before);
      return Error{ErrorCode::illegal_parameter,
                   before.empty()
                       ? "the first argument is empty; give a sub-command"
                       : text("the argument behind '", before, "' is empty; give it, or leave it out")};
    }
    if (argument.starts_with("--")) {
      const size_t equals = argument.find('=');
      if (equals != argument.npos && is_blank(argument.substr(equals + 1))) {
        return empty(argument.substr(0, equals));
      }
    } else if (argument.size() > 2 && argument.starts_with('-') && is_blank(argument.substr(2))) {
      return empty(argument.substr(0, 2));
    }
    before = argument;
  }
  return {};
}

}  // namespace scarf::tools
