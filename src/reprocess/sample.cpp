#include "reprocess/sample.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace scarf::reprocess {

std::vector<Job> sample(std::vector<Job> jobs, double share, uint64_t seed) {
  if (jobs.empty()) return jobs;
  const auto by_path = [](const Job& a, const Job& b) { return a.relative < b.relative; };
  std::sort(jobs.begin(), jobs.end(), by_path);
  const auto wanted = static_cast<size_t>(std::llround(share * static_cast<double>(jobs.size())));
  const size_t count = std::clamp<size_t>(wanted, 1, jobs.size());
  // Fisher and Yates; std::shuffle may differ between standard libraries.
  std::mt19937_64 random(seed);
  for (size_t i = 0; i < count; ++i) std::swap(jobs[i], jobs[i + random() % (jobs.size() - i)]);
  jobs.resize(count);
  std::sort(jobs.begin(), jobs.end(), by_path);
  return jobs;
}

}  // namespace scarf::reprocess
