// What became of a run, for people and for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reprocess/job.h"
#include "reprocess/shard.h"

namespace scarf::reprocess {

struct Checks {
  double share = 0;
  uint64_t seed = 0;
  std::vector<Outcome> outcomes;
};

struct Summary {
  std::string input;
  std::string device;
  Shard shard;
  size_t jobs = 1;
  size_t processes = 1;
  std::vector<Outcome> outcomes;  ///< of the recordings
  std::optional<Checks> checks;
  double seconds = 0;

  size_t count(Status status) const;
  /// Whether nothing failed, nothing was left, and every check was identical.
  bool good() const;
};

/// A table, what failed and was skipped, and the checks.
std::string summary_table(const Summary& summary);
/// The same as JSON, with a line for every recording; only "timings" depends on the clock.
std::string summary_json(const Summary& summary);
/// "summary.json", with the shard in the name where there is one.
std::string summary_name(const Shard& shard);

}  // namespace scarf::reprocess
