// Does one task, from the recording to its record.
#pragma once

#include <string>

#include "tools/reprocess/compute.h"
#include "tools/reprocess/job.h"

namespace scarf::tools::reprocess {

struct Workplace {
  Machine machine;
  std::string out;
  bool resume = false;  ///< what is finished is kept
};

/// Whatever happens becomes the outcome, exceptions included.
Outcome do_task(const Task& task, const Workplace& workplace, Meter& meter);

/// Whether a record for the job is there, of whatever recipe.
bool has_record(const std::string& out, const Job& job);

}  // namespace scarf::tools::reprocess
