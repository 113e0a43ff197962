// A random share of the finished recordings, to be checked.
#pragma once

#include <cstdint>
#include <vector>

#include "reprocess/job.h"

namespace scarf::reprocess {

/// A share p of the jobs, 0 < p <= 1: round(p * n) of them, at least 1 if there is any. The same seed and the
/// same jobs give the same choice everywhere.
std::vector<Job> sample(std::vector<Job> jobs, double share, uint64_t seed);

}  // namespace scarf::reprocess
