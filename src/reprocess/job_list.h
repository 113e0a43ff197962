// What there is to do: the recordings of a folder or of a list.
#pragma once

#include <string>
#include <vector>

#include "reprocess/job.h"
#include "reprocess/recipe.h"

namespace scarf::reprocess {

struct JobList {
  std::vector<Job> jobs;         ///< by relative path
  std::vector<Outcome> settled;  ///< what cannot or shall not be worked on
};

/// Of a folder: every regular file below it, and every folder that is a recording itself; whether a file is a
/// recording shows when it is opened. Links are followed, and each folder is listed once. The folder `out` is
/// left out. Of any other file: what read_manifest finds. Errors: io; illegal_parameter, naming the recording
/// whose settings are wrong, or two whose results would be in the same place.
Result<JobList> list_jobs(const std::string& input, const Recipe& recipe, const std::string& out);

}  // namespace scarf::reprocess
