// The scarf program: parses the command line, runs a sub-command, tells errors in one line.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <span>
#include <string>

#include "io/files/temporaries.h"
#include "scarf/version.h"
#include "tools/command_line.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"

namespace {

constexpr int kFailed = 1;    // the input, the device or the job
constexpr int kBadUsage = 2;  // the command line

int report(std::string message, int exit_code) {
  // One line, whatever a hostile file or name had in it.
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  std::cerr << "scarf: " << message << "\n";
  return exit_code;
}

// The exit code of a job that is done, unless what it printed was lost.
int finished(int exit_code) {
  std::cout.flush();
  return std::cout ? exit_code : report("cannot write to standard output", kFailed);
}

int run(const scarf::tools::Command& command, const CLI::App& app) {
  if (const auto r = scarf::tools::check_standard_streams(app); !r)
    return report(r.error().message, kBadUsage);
  const auto exit_code = command.run();
  if (!exit_code) {
    const bool usage = exit_code.error().code == scarf::ErrorCode::illegal_parameter;
    return report(scarf::tools::in_options(exit_code.error().message), usage ? kBadUsage : kFailed);
  }
  return finished(*exit_code);
}

// A standard stream that the caller closed must not become the name of the next file that is opened: it is
// taken by a file that refuses every use.
void occupy_closed_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(fd, F_GETFD) >= 0) continue;
    if (open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

std::string help_command(const CLI::App& program) {
  const auto parsed = program.get_subcommands();
  return parsed.empty() ? "scarf --help" : "scarf " + parsed.front()->get_name() + " --help";
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_streams();
  scarf::remove_temporaries_on_signals();
  CLI::App program("Event-camera streams to velocity-invariant pictures", "scarf");
  program.set_version_flag("--version", std::string("scarf ") + scarf::version_text());
  program.require_subcommand(0, 1);
  scarf::tools::Command command;
  scarf::tools::add_commands(program, command);

  try {  // CLI11 and OpenCV throw
    const auto checked =
        scarf::tools::check_arguments(std::span(argv, static_cast<size_t>(argc)).subspan(argc > 0 ? 1 : 0));
    if (!checked) return report(checked.error().message, kBadUsage);
    program.parse(argc, argv);
    if (command.run) return run(command, *program.get_subcommands().front());
    std::cout << program.help();
    return finished(kBadUsage);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return finished(program.exit(e));  // --help, --version
    return report(std::string(e.what()) + "; see " + help_command(program), kBadUsage);
  } catch (const std::bad_alloc&) {
    return report("out of memory; use a larger --cell, or a smaller --batch", kFailed);
  } catch (const std::exception& e) {
    return report(e.what(), kFailed);
  }
}
