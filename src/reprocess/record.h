// The record of a finished recording: a JSON file beside its results.
//
// It depends only on the input, the recipe, the program and the device, but for "timings" and "input_state".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reprocess/compute.h"
#include "reprocess/input_state.h"
#include "reprocess/job.h"

namespace scarf::reprocess {

/// What a record needs to be compared with later.
struct Record {
  InputIdentity input;
  std::string times_sha256;  ///< of the file of the frames' times; empty: there is none
  SettingWords settings;
  Digests digests;
  std::vector<std::string> outputs;  ///< what was added to the name of the recording
  uint64_t events = 0;
  uint64_t frames = 0;
};

struct Timings {
  std::string started;  ///< UTC, as ISO 8601
  double seconds = 0;
};

/// The content of a record.
std::string record_text(const Record& record, const Job& job, const Computed& computed,
                        const std::string& device, const Timings& timings);

/// Errors: io; bad_input if the file is no such record.
Result<Record> read_record(const std::string& path);

}  // namespace scarf::reprocess
