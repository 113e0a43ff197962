// A SCARF state as a file: the bytes that the state digest covers, behind a header that tells the geometry.
//
// Layout, all little-endian: the 8 characters "SCARFST1"; thirteen int32: sensor width and height, then x and
// y of cell, origin, grid, margin_lo and margin_hi, then the capacity; then the hashed bytes (see digest.h).
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "io/files/output_files.h"
#include "scarf/core/patch_state.h"

namespace scarf {

/// Errors: as OutputFile::create; io.
Result<void> write_state_dump(const std::string& path, const Snapshot& snapshot, const OutputRule& rule);

/// One patch of a dump.
struct DumpedPatch {
  uint64_t total = 0;
  std::vector<Event> slots;  ///< the filled ones, in slot order
};

/// Reads a dump patch by patch, so that its size does not matter.
class StateDump {
 public:
  /// Errors: io; bad_input if the file is no dump.
  static Result<StateDump> open(const std::string& path);

  const Geometry& geometry() const { return geometry_; }
  /// The next patch; to be called geometry().patches() times.
  /// Errors: bad_input, naming the patch, if the file is cut short or its content contradicts itself.
  Result<DumpedPatch> next();
  /// Errors: bad_input if there are bytes behind the last patch.
  Result<void> finish();

 private:
  StateDump(std::string path, std::ifstream file) : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;
  std::ifstream file_;
  Geometry geometry_;
  int64_t patch_ = 0;
};

}  // namespace scarf
