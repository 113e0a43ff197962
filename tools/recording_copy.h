// A recording written anew: convert and cut.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "io/output_files.h"
#include "scarf/io.h"

namespace scarf::tools {

/// Where a copy goes to.
struct CopyTarget {
  std::string path;
  std::string format;  ///< empty: by the path's extension
  bool check = false;  ///< read the copy again and compare it with what was written
};

struct Copied {
  uint64_t events = 0;  ///< written
  uint64_t left = 0;    ///< read, and not wanted
  std::string format;
  std::string digest;  ///< SHA-256 of the written events, as of scarf info --digest
};

/// Whether an event belongs to the copy; may change it.
using Choose = std::function<bool(Event&)>;

/// Writes the events of the source that `choose` wants, for a sensor of that size. Errors: whatever source
/// and sink return, as create_events; bad_input, if the copy was to be checked and is not what was written.
Result<Copied> copy_recording(EventSource& source, const Choose& choose, SensorSize sensor,
                              const CopyTarget& target, const OutputRule& rule);

/// The output, its format and --check, as options of a sub-command.
void add_copy_target(CLI::App& app, CopyTarget& target);

/// Where to say something about the copy: not where the copy itself goes to.
std::ostream& remarks(const CopyTarget& target);

/// What the copy does not have of the recording, a line each; empty: nothing is lost.
std::string losses(const EventSource& source);

}  // namespace scarf::tools
