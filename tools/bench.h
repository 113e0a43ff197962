// What the tables of `scarf bench` share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "scarf/gpu.h"
#include "scarf/parameters.h"

namespace scarf::tools {

struct BenchOptions {
  bool quick = false;
  bool stages = false;
  bool paper = false;
  bool replay = false;
  bool cpu = false;                               ///< the reference only; with `paper`
  std::string representation;                     ///< empty: what the table has by default
  std::map<std::string, std::string> parameters;  ///< of the representation, as parse_parameters takes them
  std::string file;                               ///< a recording; with `paper`
  std::optional<SensorSize> sensor;               ///< with `paper`
  std::string json, csv, plot;                    ///< files to write; empty: none
  DeviceOptions device;
};

/// The device beside the reference on synthetic scenes: pushes with an image after each. Returns the exit
/// code.
Result<int> bench_scenes(const BenchOptions& options);
/// The paper's cost table and figure for every representation. Returns the exit code.
Result<int> bench_paper(const BenchOptions& options);

/// Frames of a recording by a replay beside those of a stream that is asked for each. Returns the exit code.
Result<int> bench_replay(const BenchOptions& options);

}  // namespace scarf::tools
