// Which part of the recordings this process takes, when several share the work.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "scarf/core/result.h"

namespace scarf::reprocess {

struct Shard {
  uint64_t index = 1;  ///< 1 .. count
  uint64_t count = 1;
  std::string origin;  ///< who said so, for people; empty: all recordings are taken

  /// Whether the recording at this relative path is in the shard. Only the path decides, so that processes
  /// agree even if they see different files.
  bool takes(const std::string& relative) const;
};

/// "i/n". Errors: illegal_parameter.
Result<Shard> parse_shard(const std::string& word);

/// The value of an environment variable.
using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment process_environment();

/// One of the processes that an MPI launcher started; nullopt outside one. Errors: bad_input.
Result<std::optional<Shard>> mpi_shard(const Environment& environment);

/// Where nobody says: a task of a Slurm array, cut further by mpi_shard if `split_ranks`. Errors: bad_input,
/// for variables that contradict each other.
Result<Shard> shard_from_environment(const Environment& environment, bool split_ranks);

}  // namespace scarf::reprocess
