// Two implementations fed with the same batches and compared after every one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "compare/compare_states.h"
#include "io/files/output_files.h"
#include "scarf/core/patch_state.h"
#include "scarf/io/recordings.h"
#include "session/play.h"

namespace scarf {

struct Lockstep {
  uint64_t events = 0;                    ///< pushed to both, those of the batch that differed included
  uint64_t batches = 0;                   ///< likewise
  uint64_t agreed = 0;                    ///< events of the batches after which both sides were identical
  std::optional<std::string> difference;  ///< the first one; nothing was pushed after it
};

/// Errors: what the source returned, or what both sides said to the same batch.
Result<Lockstep> run_in_lockstep(EventSource& source, const PlayOptions& options, Representation& a,
                                 Representation& b, const SideNames& names, Tolerance* tolerance = nullptr);

/// Opens the same recording again, from its start.
using OpenAgain = std::function<Result<std::unique_ptr<EventSource>>()>;

/// Shortens a run that ended with a difference, by bisection within the batch that differed: empties both
/// sides and plays ever shorter beginnings of the stream. Where the failure does not come again, or a rerun
/// is not possible, the shortest run known so far stays. Each rerun has a tolerance of its own.
Lockstep shortest_failure(Lockstep failed, const OpenAgain& open_again, const PlayOptions& options,
                          Representation& a, Representation& b, const SideNames& names,
                          const std::function<std::unique_ptr<Tolerance>()>& make_tolerance = {});

/// Writes the first `events` events of a recording as text, so that a failure can be told and tried again.
/// Errors: whatever the recording returned; as OutputFile::create.
Result<void> write_prefix(const OpenAgain& open_again, SensorSize sensor, uint64_t events,
                          const std::string& path, const OutputRule& rule);

}  // namespace scarf
