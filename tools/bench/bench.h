// What the tables of `scarf bench` share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/ceilings.h"
#include "io/files/output_files.h"
#include "scarf/core/parameters.h"
#include "scarf/device/stream.h"

namespace scarf::tools {

struct BenchOptions {
  bool quick = false;
  bool stages = false;
  bool paper = false;
  bool offload = false;
  bool io = false;
  bool wire = false;
  std::vector<std::string> recordings;  ///< with `io` and `wire`; none: what scarf makes itself
  bool replay = false;
  std::optional<size_t> streams;                  ///< as one submission
  bool cpu = false;                               ///< the reference only; with `paper`
  std::string representation;                     ///< empty: what the table has by default
  std::map<std::string, std::string> parameters;  ///< of the representation, as parse_parameters takes them
  std::string file;                               ///< a recording; with `paper`
  std::optional<SensorSize> sensor;               ///< with `paper` and `io`
  std::string json, csv, plot;                    ///< files to write; empty: none
  DeviceOptions device;
  OutputRule rule;  ///< of the files to write
};

/// Of what all benchmarks write (docs/JSON.md).
inline constexpr int kBenchSchema = 1;

/// Writes a benchmark's JSON to the file of --json, if there is one, with the commit and, unless it is null,
/// the device.
Result<void> write_report(const BenchOptions& options, const DeviceInfo* device, nlohmann::json report);

void print_ceilings(const bench::Ceilings& ceilings);
nlohmann::json as_json(const bench::Ceilings& ceilings);

/// The device beside the reference on synthetic scenes: pushes with an image after each. Returns the exit
/// code.
Result<int> bench_scenes(const BenchOptions& options);
/// Throughput, kernel time and latency of a device that a host hands its stream to. Returns the exit code.
Result<int> bench_offload(const BenchOptions& options);
/// The readers, each beside the plain reading of its file. Returns the exit code.
Result<int> bench_io(const BenchOptions& options);
/// The paper's cost table and figure for every representation. Returns the exit code.
Result<int> bench_paper(const BenchOptions& options);
/// Size and cost of the events that are uploaded. Returns the exit code.
Result<int> bench_wire(const BenchOptions& options);

/// Many small streams in one submission beside one large stream. Returns the exit code.
Result<int> bench_streams(const BenchOptions& options);

/// Frames of a recording by a replay beside those of a stream that is asked for each. Returns the exit code.
Result<int> bench_replay(const BenchOptions& options);

}  // namespace scarf::tools
