// A recording written anew: convert and cut.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "io/files/output_files.h"
#include "scarf/io/recordings.h"
#include "tools/trigger_copy.h"

namespace scarf::tools {

/// Where a copy goes to.
struct CopyTarget {
  std::string path;
  std::string format;        ///< empty: by the path's extension
  bool check = false;        ///< read the copy again and compare it with what was written
  bool allow_empty = false;  ///< a copy without an event is no failure
};

struct Copied {
  uint64_t events = 0;        ///< written
  uint64_t left = 0;          ///< read, and not wanted
  uint64_t triggers = 0;      ///< written
  uint64_t header_lines = 0;  ///< written, of the camera's header
  std::string format;
  std::string digest;  ///< SHA-256 of the written events, as of scarf info --digest
  std::string losses;  ///< what the copy does not have of the recording, a line each; empty: nothing is lost
};

/// What belongs to the copy.
struct Choose {
  std::function<bool(Event&)> event;  ///< may change it
  ChooseTrigger trigger;
  /// Called with the first event of the recording, before the others; its error ends the copy.
  std::function<Result<void>(const Event&)> begin = [](const Event&) { return Result<void>(); };
};

/// Writes the events of the original that `choose` wants, for a sensor of that size, and its triggers and the
/// header of its camera, where the format has room for them. Errors: whatever source and sink return;
/// bad_input, if there is no event, or if the copy was to be checked and is not what was written.
Result<Copied> copy_recording(const Original& original, const Choose& choose, SensorSize sensor,
                              const CopyTarget& target, const OutputRule& rule);

/// A line about what was copied beside the events; empty: nothing was.
std::string beside_events(const Copied& copied);

/// The output, its format, --check and --allow-empty, as options of a sub-command.
void add_copy_target(CLI::App& app, CopyTarget& target);

/// Where to say something about the copy: not where the copy itself goes to.
std::ostream& remarks(const CopyTarget& target);

}  // namespace scarf::tools
