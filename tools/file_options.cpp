#include "tools/file_options.h"

#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "core/text.h"

namespace scarf::tools {
namespace {

constexpr const char* kOverwrite = "--overwrite";

// What an unset variable of a shell leaves of a name.
CLI::Option* not_empty(CLI::Option* option) {
  return option->check([](const std::string& word) {
    return word.empty() ? std::string("the name is empty") : std::string();
  });
}

}  // namespace

CLI::Option* as_input(CLI::Option* option) {
  return not_empty(option->type_name(kInputType));
}

CLI::Option* as_output(CLI::App& app, CLI::Option* option) {
  if (app.get_option_no_throw(kOverwrite) == nullptr) {
    app.add_flag(std::string(kOverwrite))
        ->description(
            "Replace files that are there; inputs, and files in folders that scarf did not write, never");
  }
  return not_empty(option->type_name(kOutputType));
}

CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::string& target,
                              const std::string& help) {
  return as_input(app.add_option(name, target, help));
}

CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                              const std::string& help) {
  return as_input(app.add_option(name, target, help));
}

CLI::Option* add_output_option(CLI::App& app, const std::string& name, std::string& target,
                               const std::string& help) {
  return as_output(app, app.add_option(name, target, help));
}

CLI::Option* add_word_option(CLI::App& app, const std::string& name, std::string& target,
                             const std::string& help) {
  return app.add_option(name, target, help)->type_name(kWordType);
}

OutputRule output_rule(const CLI::App& app) {
  const CLI::Option* const overwrite = app.get_option_no_throw(kOverwrite);
  OutputRule rule(overwrite != nullptr && overwrite->count() > 0);
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_type_name() != kInputType) continue;
    for (const std::string& path : option->results()) rule.add_input(path);
  }
  return rule;
}

Result<void> check_standard_streams(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_type_name() != kInputType) continue;
    for (const std::string& path : option->results()) {
      struct stat input {};
      const bool there = path == "-" ? fstat(STDIN_FILENO, &input) == 0 : stat(path.c_str(), &input) == 0;
      if (!there || !S_ISREG(input.st_mode)) continue;
      for (const auto& [stream, name] :
           {std::pair{STDOUT_FILENO, "standard output"}, std::pair{STDERR_FILENO, "standard error"}}) {
        struct stat output {};
        if (fstat(stream, &output) != 0 || output.st_dev != input.st_dev || output.st_ino != input.st_ino)
          continue;
        return Error{ErrorCode::illegal_parameter,
                     text(name, " is the input ", path, ", which is never written to; send it elsewhere")};
      }
    }
  }
  return {};
}

}  // namespace scarf::tools
