// Does one task, from the recording to its record.
#pragma once

#include <string>

#include "io/files/output_files.h"
#include "reprocess/compute.h"
#include "reprocess/job.h"

namespace scarf::reprocess {

struct Workplace {
  Machine machine;
  std::string out;
  bool resume = false;  ///< what is finished is kept
  OutputRule rule;

  /// Whether results of an earlier run may be replaced.
  bool replaces() const { return resume || rule.overwrite(); }
};

/// Whatever happens becomes the outcome, exceptions included.
Outcome do_task(const Task& task, const Workplace& workplace, Meter& meter);

/// Whether a record for the job is there, of whatever recipe.
bool has_record(const std::string& out, const Job& job);
/// Whether it is a record of scarf.
bool is_record(const std::string& out, const Job& job);

}  // namespace scarf::reprocess
